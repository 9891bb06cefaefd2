// Index patterns of geometric mip-mapping: a block decimated by powers of two, with fan-stitched borders.
//
// A block is an inner square and four border strips, one cell wide each, that meet in the corner cells' diagonals.
// Along its outer line a strip may be as coarse as the neighbour: the vertices between are left out and the rest is
// joined in fans. Without stitching the pattern is the decimated grid, cut along the diagonals of even corners.
// Source: de Boer, Fast Terrain Rendering Using Geometrical MipMapping (2000).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "terrain/rivals/surface_error.h"

namespace terrain {

/// Corners in cells from the block's north-west sample; counter-clockwise seen from above.
using CellTriangle = std::array<GridPoint, 3>;

/// A block's extent: `cells` x `cells`, clamped to size.x x size.y, which squeezes the surplus to nothing.
struct BlockShape {
    int cells = 0;  ///< a power of two
    GridPoint size;

    /// Spacing of the coarsest decimation is 1 << top_shift().
    int top_shift() const {
        int shift = 0;
        while (1 << shift < cells)
            ++shift;
        return shift;
    }
};

/// Appends the inner square at spacing 1 << shift; nothing at top_shift() and the next finer.
void add_inner(const BlockShape& shape, int shift, std::vector<CellTriangle>& out);

/// Appends the strip of one side (block_grid.h), its outer line at spacing 1 << outer_shift.
/// @param outer_shift  >= shift, shift < top_shift()
void add_strip(const BlockShape& shape, int side, int shift, int outer_shift, std::vector<CellTriangle>& out);

/// Appends everything at one spacing: the inner square and four strips, or the two triangles of top_shift().
void add_plain(const BlockShape& shape, int shift, std::vector<CellTriangle>& out);

}  // namespace terrain
