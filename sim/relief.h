// Relief: what the shape of the land says about each sample beyond its height; the ground's colour reads it.
#pragma once

#include <cstdint>
#include <vector>

#include "data/height_grid.h"

namespace sim {

/// One value per sample, [height * width], as in the grid.
struct Relief {
    std::vector<float>
        prominence_m;  ///< above the mean of the surroundings, about 1 km across; valleys negative
    std::vector<uint8_t> sunlight;  ///< 255: the sun is seen, 0: other land stands before it
    std::vector<uint8_t> shore;     ///< sea: cells to the nearest land, at most 254; land: 255. Empty: no sea
};

/// The kinds of land, each in time proportional to the samples. `threads` changes nothing in the result.
Relief measure_relief(const data::HeightGrid& grid, unsigned threads);

/// Whether a sample belongs to the sea: at or below 0 m and exactly level with its four neighbours.
bool is_sea(const data::HeightGrid& grid, int col, int row);

}  // namespace sim
