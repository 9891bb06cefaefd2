#include "objects/reduction/fat_faces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace objects {

namespace {

constexpr size_t kFewestCorners = 5;
constexpr double kFlatShare = 1e-12;  ///< of a face's extent, that its corners may lie off its plane
constexpr double kOneWay = 1e-10;     ///< 1 - cosine of faces that look the same way
constexpr uint32_t kNone = 0xffffffffu;

/// [points] the first that lies in the same place.
std::vector<uint32_t> first_in_place(const std::vector<glm::dvec3>& points) {
    std::vector<uint32_t> order(points.size()), first(points.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](uint32_t i) { return std::array{points[i].x, points[i].y, points[i].z}; };
    std::sort(order.begin(), order.end(),
              [&](uint32_t a, uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
    for (size_t i = 0; i < order.size(); ++i)
        first[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? first[order[i - 1]] : order[i];
    return first;
}

/// A side of a face, from one corner to the next.
struct Side {
    uint32_t from, to, face;

    auto ends() const { return std::pair(from, to); }
};

class FlatFaces {
  public:
    explicit FlatFaces(const FaceSoup& soup) : soup_(soup), place_(first_in_place(soup.points)) {
        const size_t count = soup.faces.size();
        normals_.resize(count);
        for (uint32_t face = 0; face < count; ++face) {
            const lod::Triangle t = soup.view().triangle(face);
            const glm::dvec3 cross = glm::cross(t.b - t.a, t.c - t.a);
            const double length = glm::length(cross);
            if (length > 0.0) normals_[face] = cross / length;
            for (size_t k = 0; k < 3; ++k)
                sides_.push_back({place_[soup.faces[face][k]], place_[soup.faces[face][(k + 1) % 3]], face});
        }
        std::sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) {
            return a.ends() != b.ends() ? a.ends() < b.ends() : a.face < b.face;
        });
        group_.resize(count);
        std::iota(group_.begin(), group_.end(), 0u);
        for (const Side& side : sides_) {
            const uint32_t other = across(side);
            if (other != kNone && are_one(side.face, other)) group_[find(side.face)] = find(other);
        }
    }

    FaceSoup cut_anew() {
        std::vector<std::vector<uint32_t>> faces_of(soup_.faces.size());
        for (uint32_t face = 0; face < soup_.faces.size(); ++face)
            faces_of[find(face)].push_back(face);
        std::vector<std::vector<Side>> rims(soup_.faces.size());
        for (const Side& side : sides_) {
            const uint32_t other = across(side);
            if (other == kNone || find(other) != find(side.face)) rims[find(side.face)].push_back(side);
        }
        FaceSoup out;
        out.points = soup_.points;
        std::vector<uint8_t> is_cut(soup_.faces.size(), 0);
        std::vector<std::pair<uint32_t, std::vector<uint32_t>>> rings;
        for (uint32_t group = 0; group < faces_of.size(); ++group) {
            if (faces_of[group].size() + 2 < kFewestCorners) continue;
            std::optional<std::vector<uint32_t>> ring = ring_of(rims[group]);
            if (!ring || ring->size() != faces_of[group].size() + 2 || !is_convex(*ring, normals_[group]))
                continue;
            for (const uint32_t face : faces_of[group])
                is_cut[face] = 1;
            rings.emplace_back(group, std::move(*ring));
        }
        for (uint32_t face = 0; face < soup_.faces.size(); ++face) {
            if (is_cut[face] != 0) continue;
            out.faces.push_back(soup_.faces[face]);
            out.colours.push_back(soup_.colours[face]);
        }
        for (const auto& [group, ring] : rings) {
            for (const auto& face : fat_triangles(ring)) {
                out.faces.push_back(face);
                out.colours.push_back(soup_.colours[group]);
            }
        }
        return out;
    }

  private:
    uint32_t find(uint32_t face) {
        while (group_[face] != face)
            face = group_[face] = group_[group_[face]];
        return face;
    }

    /// The face that alone passes a side the other way.
    uint32_t across(const Side& side) const {
        const auto before = [](const Side& a, const Side& b) { return a.ends() < b.ends(); };
        const auto [mine, mine_end] = std::equal_range(sides_.begin(), sides_.end(), side, before);
        const auto [begin, end] =
            std::equal_range(sides_.begin(), sides_.end(), Side{side.to, side.from, 0}, before);
        return mine_end - mine == 1 && end - begin == 1 ? begin->face : kNone;
    }

    bool are_one(uint32_t a, uint32_t b) const {
        return soup_.colours[a] == soup_.colours[b] && glm::dot(normals_[a], normals_[b]) > 1.0 - kOneWay;
    }

    /// Sides as one closed ring.
    static std::optional<std::vector<uint32_t>> ring_of(const std::vector<Side>& rim) {
        std::vector<uint32_t> ring;
        if (rim.empty()) return std::nullopt;  // closed: so finely bent that it passed for flat
        const auto from = [&](uint32_t corner) {
            return std::lower_bound(rim.begin(), rim.end(), corner,
                                    [](const Side& side, uint32_t at) { return side.from < at; });
        };
        uint32_t at = rim[0].from;
        do {
            const auto side = from(at);
            if (side == rim.end() || side->from != at || ring.size() == rim.size()) return std::nullopt;
            ring.push_back(at);
            at = side->to;
        } while (at != rim[0].from);
        if (ring.size() != rim.size()) return std::nullopt;
        return ring;
    }

    /// Flat, and turning left at every corner.
    bool is_convex(const std::vector<uint32_t>& ring, const glm::dvec3& normal) const {
        const size_t n = ring.size();
        double around = 0.0, extent_m = 0.0;
        const glm::dvec3 start = soup_.points[ring[0]];
        for (const uint32_t corner : ring)
            extent_m = std::max(extent_m, glm::length(soup_.points[corner] - start));
        for (size_t i = 0; i < n; ++i) {
            const glm::dvec3 a = soup_.points[ring[i]], b = soup_.points[ring[(i + 1) % n]],
                             c = soup_.points[ring[(i + 2) % n]];
            if (std::abs(glm::dot(normal, a - start)) > kFlatShare * extent_m) return false;
            const double sine = glm::dot(normal, glm::cross(b - a, c - b));
            if (!(sine > 0.0)) return false;
            around += std::atan2(sine, glm::dot(b - a, c - b));
        }
        return around < 7.0;  // once around, 2 pi
    }

    const FaceSoup& soup_;
    std::vector<uint32_t> place_;
    std::vector<glm::dvec3> normals_;
    std::vector<Side> sides_;  ///< in the order of their ends
    std::vector<uint32_t> group_;
};

}  // namespace

std::vector<std::array<uint32_t, 3>> fat_triangles(std::span<const uint32_t> ring) {
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<uint32_t> outer(ring.begin(), ring.end()), inner;
    while (outer.size() >= 3) {
        // Every other corner is cut off; what is left is the next ring.
        inner.clear();
        for (size_t i = 0; i < outer.size(); i += 2) {
            inner.push_back(outer[i]);
            if (i + 1 < outer.size() && outer.size() > 3)
                triangles.push_back({outer[i], outer[i + 1], outer[(i + 2) % outer.size()]});
        }
        if (outer.size() == 3) triangles.push_back({outer[0], outer[1], outer[2]});
        if (outer.size() <= 4) break;
        outer.swap(inner);
    }
    return triangles;
}

FaceSoup with_fat_faces(const FaceSoup& soup) {
    return FlatFaces(soup).cut_anew();
}

}  // namespace objects
