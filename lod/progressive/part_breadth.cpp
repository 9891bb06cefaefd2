#include "lod/progressive/part_breadth.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lod {
namespace {

/// Sums over a part.
struct PartSize {
    double area_m2 = 0.0, volume_m3 = 0.0, border_m = 0.0;

    double breadth_m() const {
        if (area_m2 == 0.0) return 0.0;
        return border_m > 0.0 ? 2.0 * area_m2 / border_m : 4.0 * std::abs(volume_m3) / area_m2;
    }
};

/// [leaves] one leaf of the same part, the same for all of them.
std::vector<uint32_t> heads_of(const VertexHierarchy& h) {
    std::vector<uint32_t> head(h.leaf_count);
    std::iota(head.begin(), head.end(), 0u);
    const auto find = [&head](uint32_t leaf) {
        while (head[leaf] != leaf)
            leaf = head[leaf] = head[head[leaf]];
        return leaf;
    };
    for (const auto& [a, b, c] : h.triangles)
        head[find(b)] = head[find(c)] = find(a);
    for (uint32_t leaf = 0; leaf < h.leaf_count; ++leaf)
        head[leaf] = find(leaf);
    return head;
}

/// Edges that have one triangle.
std::vector<std::array<uint32_t, 2>> border_of(const VertexHierarchy& h) {
    std::vector<std::array<uint32_t, 2>> sides, border;
    for (const auto& corners : h.triangles) {
        for (size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(corners[k], corners[(k + 1) % 3]);
            sides.push_back({low, high});
        }
    }
    std::sort(sides.begin(), sides.end());
    for (size_t i = 0; i < sides.size(); ++i) {
        const bool is_alone =
            (i == 0 || sides[i - 1] != sides[i]) && (i + 1 == sides.size() || sides[i + 1] != sides[i]);
        if (is_alone) border.push_back(sides[i]);
    }
    return border;
}

}  // namespace

std::vector<double> breadths_of_leaves(const VertexHierarchy& h) {
    const std::vector<uint32_t> head = heads_of(h);
    std::vector<PartSize> sizes(h.leaf_count);
    const auto at = [&h](uint32_t leaf) { return glm::dvec3(h.position[leaf]); };
    for (const auto& [i, j, k] : h.triangles) {
        const glm::dvec3 origin = at(head[i]), a = at(i) - origin, b = at(j) - origin, c = at(k) - origin;
        sizes[head[i]].area_m2 += 0.5 * glm::length(glm::cross(b - a, c - a));
        sizes[head[i]].volume_m3 += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    for (const auto& [a, b] : border_of(h))
        sizes[head[a]].border_m += glm::distance(at(a), at(b));
    std::vector<double> breadths;
    for (uint32_t leaf = 0; leaf < h.leaf_count; ++leaf)
        breadths.push_back(sizes[head[leaf]].breadth_m());
    return breadths;
}

double seen_error_m(double error_m, double breadth_m) {
    constexpr double kLostWeight = 8.0, kLostShare = 0.25;
    if (error_m >= kLostShare * breadth_m) return kLostWeight * error_m;
    const double share = error_m / (kLostShare * breadth_m);
    return error_m * (1.0 + (kLostWeight - 1.0) * share * share);
}

}  // namespace lod
