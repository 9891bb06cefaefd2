// Position along a Hilbert curve through space: neighbours on the curve are neighbours in space.
#pragma once

#include <array>
#include <cstdint>

namespace objects {

/// Index of a cell on the Hilbert curve that fills a cube of 2^21 cells a side. Cells with consecutive indices share a
/// face.
/// Source: Skilling, Programming the Hilbert curve (2004).
constexpr uint64_t hilbert_index3(uint32_t x, uint32_t y, uint32_t z) {
    constexpr uint32_t kBits = 21;
    std::array<uint32_t, 3> axis = {x, y, z};
    for (uint32_t bit = 1u << (kBits - 1); bit > 1; bit >>= 1) {
        const uint32_t below = bit - 1;
        for (uint32_t& one : axis) {
            if ((one & bit) != 0) {
                axis[0] ^= below;
            } else {
                const uint32_t swapped = (axis[0] ^ one) & below;
                axis[0] ^= swapped;
                one ^= swapped;
            }
        }
    }
    axis[1] ^= axis[0];
    axis[2] ^= axis[1];
    uint32_t turned = 0;
    for (uint32_t bit = 1u << (kBits - 1); bit > 1; bit >>= 1) {
        if ((axis[2] & bit) != 0) turned ^= bit - 1;
    }
    uint64_t index = 0;
    for (uint32_t bit = kBits; bit-- > 0;) {
        for (uint32_t one : axis)
            index = (index << 1) | (((one ^ turned) >> bit) & 1u);
    }
    return index;
}

}  // namespace objects
