// Position along a Hilbert curve: neighbours on the curve are neighbours in the plane.
#pragma once

#include <cstdint>

namespace objects {

/// Index of cell (x, y) on the Hilbert curve that fills a square of 2^16 by 2^16 cells, starting at (0, 0).
/// Cells with consecutive indices share an edge.
/// Source: Hilbert, Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck (1891).
constexpr uint32_t hilbert_index(uint16_t x, uint16_t y) {
    uint32_t col = x, row = y, index = 0;
    for (uint32_t side = 1u << 15; side > 0; side >>= 1) {
        const uint32_t right = (col & side) != 0 ? 1 : 0;
        const uint32_t upper = (row & side) != 0 ? 1 : 0;
        index = (index << 2) | ((3 * right) ^ upper);
        if (upper == 0) {  // the lower quarters are entered mirrored, so that the curve joins
            if (right == 1) {
                col = ~col;
                row = ~row;
            }
            const uint32_t swapped = col;
            col = row;
            row = swapped;
        }
    }
    return index;
}

}  // namespace objects
