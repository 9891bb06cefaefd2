// HeightExtremes: the lowest and highest ground, and whether there are voids, in blocks of a grid and blocks of blocks.
// What a search for the worst of many samples skips by, where looking at each would cost the whole grid.
//
//     level 0     one block over everything
//     …           a block holds four of the next level
//     finest      8 x 8 samples; blocks do not overlap: 0.19 bytes a sample in all
#pragma once

#include <vector>

#include "data/height_grid.h"

namespace data {

/// Heights of void samples count, as they are interpolated.
struct HeightExtremes {
    static constexpr int kFinestShift = 3;

    struct Block {
        float min_m = 0.0f, max_m = 0.0f;
        bool any_valid = false, any_void = false;
    };
    struct Level {
        int columns = 0, rows = 0;
        int shift = 0;              ///< a block is 2^shift samples wide
        std::vector<Block> blocks;  ///< [rows * columns]

        size_t index(int col, int row) const {
            return static_cast<size_t>(row) * static_cast<size_t>(columns) + static_cast<size_t>(col);
        }
    };
    std::vector<Level> levels;  ///< level 0 first; at least one
};

/// Of the grid as it is now. The result does not depend on the number of threads.
/// Cost: O(n), about 1 ns a sample.
HeightExtremes make_height_extremes(const HeightGrid& grid, unsigned threads);

/// Takes changed samples over; `changed` lies in the grid. Cost: O(changed samples + levels).
void update(HeightExtremes& extremes, const HeightGrid& grid, const SampleRange& changed);

}  // namespace data
