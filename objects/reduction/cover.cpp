#include "objects/reduction/cover.h"

#include <algorithm>
#include <numeric>

#include "lod/base/check.h"
#include "lod/surface/surface_distance.h"

namespace objects {

namespace {

constexpr double kSmallestShare = 1.0 / 4;
constexpr uint32_t kMostPieces = 256;  ///< of a face; what is harder to prove is kept

}  // namespace

FaceSoup large_cover(const FaceSoup& source, double limit_m, uint32_t settled) {
    CHECK(limit_m > 0.0);
    const size_t count = source.faces.size();
    CHECK(settled <= count);
    std::vector<double> area2(count);
    for (size_t face = 0; face < count; ++face) {
        const lod::Triangle t = source.view().triangle(face);
        const glm::dvec3 cross = glm::cross(t.b - t.a, t.c - t.a);
        area2[face] = glm::dot(cross, cross);
    }
    std::vector<uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin() + settled, order.end(),
              [&](uint32_t a, uint32_t b) { return area2[a] != area2[b] ? area2[a] > area2[b] : a < b; });
    lod::TriangleTree kept(source.view());
    kept.hide_all();
    std::vector<uint8_t> is_kept(count, 0);
    lod::PieceSearch search{.most_pieces = kMostPieces, .smallest_share = kSmallestShare};
    for (uint32_t face : order) {
        if (face >= settled && lod::is_within(source.view().triangle(face), kept, limit_m, search)) continue;
        kept.show(face);
        is_kept[face] = 1;
    }
    FaceSoup cover;
    cover.points = source.points;
    for (size_t face = 0; face < count; ++face) {
        if (!is_kept[face]) continue;
        cover.faces.push_back(source.faces[face]);
        cover.colours.push_back(source.colours[face]);
    }
    return cover;
}

}  // namespace objects
