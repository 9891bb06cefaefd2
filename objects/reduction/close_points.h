// Pairs of points that lie within reach of each other, found cell by cell.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

namespace objects {

/// Pairs (a, b), a < b, no farther apart than `reach_m`, in rising order; at most `most` for every a, the first in the
/// order of their cells. None when the reach is not positive.
/// Cost: O(n log n) for points that are spread evenly.
std::vector<std::pair<uint32_t, uint32_t>> close_pairs(std::span<const glm::dvec3> points, double reach_m,
                                                       uint32_t most);

}  // namespace objects
