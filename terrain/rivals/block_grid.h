// BlockGrid: a raster cut into square blocks of equal size; those on the east and south rim may be smaller.
//
// Sides are numbered 0 north, 1 east, 2 south, 3 west; the opposite of k is k + 2.
#pragma once

#include <algorithm>
#include <cstdint>

#include "terrain/diamond.h"
#include "terrain/rivals/ground_box.h"

namespace terrain {

struct BlockGrid {
    static constexpr uint32_t kNoBlock = 0xffffffffu;

    int width = 0, height = 0;  ///< samples, at least 2
    int cells = 0;              ///< along a whole block's side, a power of two
    int columns = 0, rows = 0;  ///< of blocks

    uint32_t count() const { return static_cast<uint32_t>(columns) * static_cast<uint32_t>(rows); }

    /// The block's north-west sample.
    GridPoint origin(uint32_t block) const {
        const int b = static_cast<int>(block);
        return {b % columns * cells, b / columns * cells};
    }
    /// Cells along x and y.
    GridPoint size(uint32_t block) const {
        const GridPoint at = origin(block);
        return {std::min(cells, width - 1 - at.x), std::min(cells, height - 1 - at.y)};
    }
    GridPatch patch(uint32_t block) const {
        const GridPoint at = origin(block), n = size(block);
        return {at.x, at.y, at.x + n.x, at.y + n.y};
    }
    /// kNoBlock beyond the rim.
    uint32_t neighbour(uint32_t block, int side) const {
        const int b = static_cast<int>(block);
        const int x = b % columns + (side == 1) - (side == 3), y = b / columns + (side == 2) - (side == 0);
        if (x < 0 || y < 0 || x >= columns || y >= rows) return kNoBlock;
        return static_cast<uint32_t>(y * columns + x);
    }
};

/// @param cells  a power of two
inline BlockGrid make_block_grid(int width, int height, int cells) {
    return {width, height, cells, (width - 2) / cells + 1, (height - 2) / cells + 1};
}

}  // namespace terrain
