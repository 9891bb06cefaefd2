#include "lod/base/hilbert3.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

namespace lod {
namespace {

TEST(Hilbert3, FillsCubesWithoutAJumpOrAGap) {
    constexpr uint32_t kSide = 32, kCells = kSide * kSide * kSide;
    std::vector<uint32_t> cell_at(kCells, UINT32_MAX);
    for (uint32_t cell = 0; cell < kCells; ++cell) {
        const uint64_t index = hilbert_index(cell % kSide, cell / kSide % kSide, cell / kSide / kSide);
        ASSERT_LT(index, kCells) << "the first cells fill the cube at the origin";
        ASSERT_EQ(cell_at[index], UINT32_MAX) << "two cells share an index";
        cell_at[index] = cell;
    }
    EXPECT_EQ(cell_at[0], 0u);
    const auto axis = [](uint32_t cell, uint32_t scale) { return static_cast<int>(cell / scale % kSide); };
    for (uint32_t i = 1; i < kCells; ++i) {
        int steps = 0;
        for (const uint32_t scale : {1u, kSide, kSide * kSide})
            steps += std::abs(axis(cell_at[i], scale) - axis(cell_at[i - 1], scale));
        ASSERT_EQ(steps, 1) << "between " << i - 1 << " and " << i;
    }
}

TEST(Hilbert3, UsesAllBits) {
    constexpr uint32_t kLast = (1u << 21) - 1;
    uint64_t largest = 0;
    for (uint32_t corner = 0; corner < 8; ++corner) {
        const auto at = [&](uint32_t axis) { return (corner >> axis & 1) != 0 ? kLast : 0; };
        largest = std::max(largest, hilbert_index(at(0), at(1), at(2)));
    }
    EXPECT_EQ(largest, (uint64_t{1} << 63) - 1) << "the curve ends in a corner of the whole cube";
}

}  // namespace
}  // namespace lod
