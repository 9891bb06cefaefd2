// Welding: positions that are equal, or nearly so, get one number.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace lod {

/// Numbers places 0, 1, … in order of first appearance.
/// @param within  >= 0; a position this near to an earlier place (the first such) is that place; 0: equal bits, -0 is 0
/// @returns       [positions] the place of each
/// Cost: O(n) expected, while no more than some positions share a cell of size `within`.
std::vector<uint32_t> number_places(std::span<const glm::vec3> positions, double within);

}  // namespace lod
