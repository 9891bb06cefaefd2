// Relief: what the shape of the land says about each sample beyond its height; the ground's colour reads it.
#pragma once

#include <cstdint>
#include <vector>

#include "data/height_grid.h"

namespace sim {

/// One value per sample of a range of the grid, row-major.
struct Relief {
    data::SampleRange range;
    std::vector<float>
        prominence_m;  ///< above the mean of the surroundings, about 1 km across; valleys negative
    std::vector<uint8_t> sunlight;  ///< 255: the sun is seen, 0: other land stands before it
    std::vector<uint8_t> shore;     ///< sea: cells to the nearest land, at most 254; land: 255. Empty: no sea

    /// Of a sample in the range.
    size_t index(int col, int row) const {
        return static_cast<size_t>(row - range.min.y) * static_cast<size_t>(range.columns()) +
               static_cast<size_t>(col - range.min.x);
    }
};

/// The kinds of land, each in time proportional to the samples. `threads` changes nothing in the result.
Relief measure_relief(const data::HeightGrid& grid, unsigned threads);

/// The same for a range, from as much of the grid around it as bears on it: land that may stand before the sun, 1 km of
/// surroundings, the sea out to 254 cells. Differs from the whole by the rounding of means.
/// Cost: O(samples of that).
Relief measure_relief(const data::HeightGrid& grid, const data::SampleRange& range, unsigned threads);

/// Cells north-west of land this much higher than another place that its shadow may reach there: west, north.
glm::ivec2 shadow_reach(const data::HeightGrid& grid, double rise_m);

/// Whether a sample belongs to the sea: at or below 0 m and exactly level with its four neighbours.
bool is_sea(const data::HeightGrid& grid, int col, int row);

}  // namespace sim
