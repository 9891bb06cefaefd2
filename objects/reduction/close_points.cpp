#include "objects/reduction/close_points.h"

#include <algorithm>
#include <cmath>
#include <compare>

namespace objects {

namespace {

struct Cell {
    int64_t x = 0, y = 0, z = 0;

    auto operator<=>(const Cell&) const = default;
};

struct Entry {
    Cell cell;
    uint32_t point = 0;

    auto operator<=>(const Entry&) const = default;
};

}  // namespace

std::vector<std::pair<uint32_t, uint32_t>> close_pairs(std::span<const glm::dvec3> points, double reach_m,
                                                       uint32_t most) {
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    if (points.size() < 2 || !(reach_m > 0.0)) return pairs;
    glm::dvec3 low = points[0];
    for (const glm::dvec3& point : points)
        low = glm::min(low, point);
    std::vector<Entry> entries(points.size());
    for (uint32_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 at = (points[i] - low) / reach_m;
        entries[i] = {{int64_t(at.x), int64_t(at.y), int64_t(at.z)}, i};
    }
    std::sort(entries.begin(), entries.end());
    std::vector<uint32_t> found(points.size(), 0);
    for (int64_t dx = -1; dx <= 1; ++dx) {
        for (int64_t dy = -1; dy <= 1; ++dy) {
            // Cells of a row lie together; both cursors only go forward.
            size_t begin = 0;
            for (const Entry& entry : entries) {
                const Cell first{entry.cell.x + dx, entry.cell.y + dy, entry.cell.z - 1};
                const Cell last{first.x, first.y, entry.cell.z + 1};
                while (begin < entries.size() && entries[begin].cell < first)
                    ++begin;
                for (size_t i = begin; i < entries.size() && entries[i].cell <= last; ++i) {
                    const uint32_t a = entry.point, b = entries[i].point;
                    if (a >= b || found[a] >= most) continue;
                    const glm::dvec3 apart = points[a] - points[b];
                    if (glm::dot(apart, apart) > reach_m * reach_m) continue;
                    ++found[a];
                    pairs.emplace_back(a, b);
                }
            }
        }
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace objects
