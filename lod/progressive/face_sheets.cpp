#include "lod/progressive/face_sheets.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>

namespace lod {
namespace {

constexpr double kFoldCos = -0.999;

/// A side of a triangle: corner 3 * face + k to the next one; `low` and `high` are its places.
struct Side {
    uint32_t low = 0, high = 0, corner = 0;
    bool is_rising = false;  ///< runs from low to high
};

/// By the lower place, then the higher one, then the corner.
std::vector<Side> sorted_sides(const Faces& faces, uint32_t places) {
    std::vector<Side> sides(3 * faces.places.size());
    const auto side_at = [&faces](uint32_t corner) {
        const uint32_t from = faces.places[corner / 3][corner % 3];
        const uint32_t next = next_corner(corner), to = faces.places[next / 3][next % 3];
        return Side{std::min(from, to), std::max(from, to), corner, from < to};
    };
    std::vector<uint32_t> next(places + 1, 0);
    for (uint32_t corner = 0; corner < sides.size(); ++corner)
        ++next[side_at(corner).low + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (uint32_t corner = 0; corner < sides.size(); ++corner) {
        const Side side = side_at(corner);
        sides[next[side.low]++] = side;
    }
    for (size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
        while (end < sides.size() && sides[end].low == sides[begin].low)
            ++end;
        std::sort(&sides[begin], &sides[begin] + (end - begin), [](const Side& a, const Side& b) {
            return std::tie(a.high, a.corner) < std::tie(b.high, b.corner);
        });
    }
    return sides;
}

/// Two sides that may become mates.
struct SidePair {
    double straightness = 0.0;
    uint32_t rising = 0, falling = 0;
};

/// Joins the triangles at one edge in pairs that run opposite ways, the straightest continuation first.
/// @param mates  [corners] the side's mate, kNoCorner: a border
/// @param pairs  scratch
void pair_sides(std::span<const Side> sides, const Faces& faces, std::vector<SidePair>& pairs,
                std::vector<CornerId>& mates) {
    pairs.clear();
    for (const Side& rising : sides) {
        for (const Side& falling : sides) {
            if (!rising.is_rising || falling.is_rising) continue;
            const double cosine = glm::dot(faces.normal[rising.corner / 3], faces.normal[falling.corner / 3]);
            if (cosine > kFoldCos) pairs.push_back({cosine, rising.corner, falling.corner});
        }
    }
    std::sort(pairs.begin(), pairs.end(), [](const SidePair& a, const SidePair& b) {
        return std::tie(b.straightness, a.rising, a.falling) < std::tie(a.straightness, b.rising, b.falling);
    });
    for (const SidePair& pair : pairs) {
        if (mates[pair.rising] != kNoCorner || mates[pair.falling] != kNoCorner) continue;
        mates[pair.rising] = pair.falling;
        mates[pair.falling] = pair.rising;
    }
}

}  // namespace

Sheets join_sheets(const Faces& faces, uint32_t places, MeshReport& report) {
    Sheets sheets{std::vector<CornerId>(3 * faces.places.size(), kNoCorner), std::vector<uint8_t>(places, 0)};
    const std::vector<Side> sides = sorted_sides(faces, places);
    std::vector<SidePair> pairs;
    for (size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
        while (end < sides.size() && sides[end].low == sides[begin].low &&
               sides[end].high == sides[begin].high)
            ++end;
        const std::span<const Side> edge(&sides[begin], end - begin);
        pair_sides(edge, faces, pairs, sheets.mates);
        size_t unpaired = 0;
        for (const Side& side : edge)
            unpaired += sheets.mates[side.corner] == kNoCorner ? 1u : 0u;
        report.border_edges += edge.size() == 1 ? 1u : 0u;
        const bool is_folded = edge.size() == 2 && edge[0].is_rising != edge[1].is_rising;
        if (edge.size() == 1 || is_folded) continue;
        ++report.non_manifold_edges;
        if (unpaired == 0) continue;
        sheets.is_place_locked[edge[0].low] = sheets.is_place_locked[edge[0].high] = 1;
    }
    return sheets;
}

}  // namespace lod
