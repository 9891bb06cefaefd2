// HeightPyramid: the highest ground within any rectangle of a grid, in four looks. What lines of sight skip by.
//
//     level 0     one node over everything
//     …           a node covers four of the level below; with its border, so neighbours share samples
//     finest      4 x 4 cells, the highest of 5 x 5 samples: 0.34 bytes a sample in all
#pragma once

#include <vector>

#include "data/height_grid.h"

namespace data {

/// Void samples count with the height that is interpolated there.
struct HeightPyramid {
    static constexpr int kFinestShift = 2;

    struct Level {
        int columns = 0, rows = 0;
        int shift = 0;             ///< a node is 2^shift cells wide
        std::vector<float> max_m;  ///< [rows * columns]
    };
    std::vector<Level> levels;  ///< level 0 first; at least one
    int width = 0, height = 0;  ///< samples of the grid
};

/// Of the grid as it is now. The result does not depend on the number of threads.
/// @param threads  >= 1
/// Cost: O(n), about 1 ns a sample (query_bench).
HeightPyramid make_height_pyramid(const HeightGrid& grid, unsigned threads);

/// Takes changed samples over. @param changed  clipped to the grid. Cost: O(changed samples + levels).
void update(HeightPyramid& pyramid, const HeightGrid& grid, const SampleRange& changed);

/// No ground in the rectangle between two grid positions is higher than this; -infinity where there is none.
/// Looks at two nodes each way, of the finest level whose nodes are as large as the rectangle.
float highest_m(const HeightPyramid& pyramid, const glm::dvec2& min_grid, const glm::dvec2& max_grid);

}  // namespace data
