// Position along a Hilbert curve through space: neighbours on the curve are neighbours in the cube.
#pragma once

#include <array>
#include <cstdint>

namespace lod {

/// Index of the cell (x, y, z), each below 2^21, on the Hilbert curve that fills the cube from (0, 0, 0).
/// Cells with consecutive indices share a face; the first 8^k cells fill the cube of 2^k cells at the origin.
/// Source: Skilling, Programming the Hilbert curve (2004): axes to transpose.
constexpr uint64_t hilbert_index(uint32_t x, uint32_t y, uint32_t z) {
    constexpr uint32_t kTop = 1u << 20;
    std::array<uint32_t, 3> axes = {x, y, z};
    for (uint32_t bit = kTop; bit > 1; bit >>= 1) {
        const uint32_t below = bit - 1;
        for (uint32_t& axis : axes) {
            if ((axis & bit) != 0) {
                axes[0] ^= below;
            } else {
                const uint32_t swapped = (axes[0] ^ axis) & below;
                axes[0] ^= swapped;
                axis ^= swapped;
            }
        }
    }
    axes[1] ^= axes[0];
    axes[2] ^= axes[1];
    uint32_t turned = 0;
    for (uint32_t bit = kTop; bit > 1; bit >>= 1) {
        if ((axes[2] & bit) != 0) turned ^= bit - 1;
    }
    uint64_t index = 0;
    for (uint32_t bit = kTop; bit > 0; bit >>= 1) {
        for (const uint32_t axis : axes)
            index = (index << 1) | (((axis ^ turned) & bit) != 0 ? 1 : 0);
    }
    return index;
}

}  // namespace lod
