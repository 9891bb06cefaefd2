// Colours of one building, chosen from a small palette by a seed: stucco, brick, stone; tile, slate, gravel.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace objects {

/// sRGB.
struct BuildingColours {
    glm::u8vec3 wall{0};
    glm::u8vec3 foot{0};  ///< the wall near the ground, where less of the sky reaches it
    glm::u8vec3 roof{0};
    glm::u8vec3 underside{0};
};

/// The same for equal arguments on every machine.
/// @param height_m  tall buildings get the walls and flat roofs of tall buildings
BuildingColours building_colours(uint64_t seed, int64_t building_id, double height_m);

}  // namespace objects
