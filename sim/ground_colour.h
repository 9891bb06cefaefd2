// Ground colour: what grows or lies on a spot of land, told from its height, slope and surroundings.
//
// Nothing here is measured: it is a painter's guess at fields, woods, meadows, rock, snow and water, so that
// relief without imagery reads as a landscape.
#pragma once

#include <glm/glm.hpp>

namespace sim {

/// A spot of land or sea.
struct GroundSpot {
    glm::vec2 position_m{0.0f};  ///< east and south of the grid's corner: where noise is taken
    float height_m = 0.0f;
    float slope = 0.0f;         ///< rise over run
    float prominence_m = 0.0f;  ///< above the surroundings
    float sea = 0.0f;           ///< share of sea, [0, 1]
    float shore_m = 0.0f;       ///< at sea: distance to land
};

/// Heights that belong to a latitude.
struct Climate {
    float tree_line_m = 1900.0f;
    float snow_line_m = 2800.0f;
};

/// Rough lines of a temperate year; @param latitude_rad  either hemisphere
Climate climate_at(double latitude_rad);

/// The spot's own colour, display values in [0, 1], without any light.
glm::vec3 ground_albedo(const GroundSpot& spot, const Climate& climate);

}  // namespace sim
