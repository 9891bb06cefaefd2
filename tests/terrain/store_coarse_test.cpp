// The coarse ground of a store: the raster's own samples at the raster's own places.
#include "terrain/store/coarse_ground.h"

#include <gtest/gtest.h>

#include "tests/terrain/store_kit.h"

namespace {

void expect_samples(const data::HeightGrid& grid, int max_side, int stride) {
    const test::CutFolder folder;
    const terrain::StoreFile store = terrain_test::build_and_open(grid, folder.file("a.hts"));
    const auto coarse = terrain::read_coarse_ground(store, max_side);
    ASSERT_TRUE(coarse) << coarse.message();
    ASSERT_EQ(coarse->stride, stride);
    EXPECT_LE(std::max(coarse->grid.width, coarse->grid.height), max_side);
    EXPECT_GT(coarse->grid.width * stride, grid.width - 1);
    for (int row = 0; row < coarse->grid.height; ++row) {
        for (int col = 0; col < coarse->grid.width; ++col) {
            ASSERT_EQ(coarse->grid.at(col, row), grid.at(col * stride, row * stride)) << col << ", " << row;
            ASSERT_EQ(coarse->grid.void_at(col, row), grid.void_at(col * stride, row * stride));
        }
    }
    for (int i = 0; i <= 8; ++i) {
        const int col = (coarse->grid.width - 1) * i / 8, row = (coarse->grid.height - 1) * (8 - i) / 8;
        const glm::dvec3 here = coarse->grid.frame.world_from_sample(col, row, 50.0);
        EXPECT_LT(glm::distance(here, grid.frame.world_from_sample(col * stride, row * stride, 50.0)), 1e-6);
    }
}

TEST(CoarseGround, IsAllOfItWhereThatFits) {
    expect_samples(terrain_test::fractal_grid(257, 257, 10.0, 300.0, 1), 257, 1);
    expect_samples(terrain_test::fractal_grid(200, 131, 10.0, 300.0, 2), 4096, 1);
}
TEST(CoarseGround, IsEveryNthSample) {
    expect_samples(terrain_test::fractal_grid(257, 257, 10.0, 300.0, 1), 256, 2);
    expect_samples(terrain_test::half_void_grid(600, 333), 100, 8);
    expect_samples(terrain_test::geographic_grid(300, 513), 40, 16);
}
TEST(CoarseGround, IsFourCornersAtLeast) {
    expect_samples(terrain_test::fractal_grid(257, 257, 10.0, 300.0, 1), 2, 256);
}

}  // namespace
