// The pyramid against every sample.
#include "data/height_pyramid.h"

#include <gtest/gtest.h>

#include "tests/data/ground_twin.h"

namespace {

using data::HeightGrid;
using data::HeightPyramid;

float highest_sample(const HeightGrid& grid, glm::ivec2 min, glm::ivec2 max) {
    float highest = -INFINITY;
    for (int row = std::max(min.y, 0); row <= std::min(max.y, grid.height - 1); ++row) {
        for (int col = std::max(min.x, 0); col <= std::min(max.x, grid.width - 1); ++col)
            highest = std::max(highest, grid.at(col, row));
    }
    return highest;
}

bool is_same(const HeightPyramid& a, const HeightPyramid& b) {
    bool same = a.levels.size() == b.levels.size();
    for (size_t i = 0; same && i < a.levels.size(); ++i)
        same = a.levels[i].max_m == b.levels[i].max_m;
    return same;
}

TEST(HeightPyramid, BoundsEveryRectangle) {
    for (const auto& [width, height] : {std::pair(2, 2), {5, 5}, {6, 2}, {83, 57}, {129, 65}}) {
        const HeightGrid grid = test::rough_grid(width, height, test::kPlanarTransform, "", 300.0);
        const HeightPyramid pyramid = data::make_height_pyramid(grid, 1);
        EXPECT_EQ(pyramid.levels[0].max_m, std::vector<float>{grid.max_m});
        lod::Rng rng(7);
        for (int i = 0; i < 3000; ++i) {
            const glm::dvec2 a(rng.between(-3.0, width + 2.0), rng.between(-3.0, height + 2.0));
            const double size = std::exp(rng.between(-4.0, 5.0));
            const glm::dvec2 b = a + glm::dvec2(rng.unit(), rng.unit()) * size;
            const bool is_in = b.x >= 0 && b.y >= 0 && a.x <= width - 1 && a.y <= height - 1;
            const float there = data::highest_m(pyramid, a, b);
            ASSERT_EQ(std::isfinite(there), is_in);
            if (!is_in) continue;
            const glm::ivec2 low(glm::floor(a)), high(glm::ceil(b));
            ASSERT_GE(there, highest_sample(grid, low, high));
            // Two nodes each way, each at most twice as large as the rectangle in cells, at least 4.
            const glm::ivec2 around(4 + 4 * static_cast<int>(std::ceil(std::max(b.x - a.x, b.y - a.y)) + 1));
            ASSERT_LE(there, highest_sample(grid, low - around, high + around));
        }
    }
}

TEST(HeightPyramid, ThreadsDoNotMatter) {
    const HeightGrid grid = test::rough_grid(83, 57, test::kPlanarTransform, "", 300.0);
    for (unsigned threads : {2u, 3u, 64u})
        EXPECT_TRUE(is_same(data::make_height_pyramid(grid, 1), data::make_height_pyramid(grid, threads)));
}

TEST(HeightPyramid, FollowsChanges) {
    HeightGrid grid = test::rough_grid(83, 57, test::kPlanarTransform, "", 300.0);
    HeightPyramid pyramid = data::make_height_pyramid(grid, 1);
    lod::Rng rng(8);
    for (int i = 0; i < 200; ++i) {
        const glm::ivec2 min(static_cast<int>(rng.below(90)) - 4, static_cast<int>(rng.below(64)) - 4);
        const glm::ivec2 max =
            min + glm::ivec2(static_cast<int>(rng.below(12)), static_cast<int>(rng.below(12)));
        for (int row = std::max(min.y, 0); row <= std::min(max.y, 56); ++row) {
            for (int col = std::max(min.x, 0); col <= std::min(max.x, 82); ++col)
                grid.height_m[grid.index(col, row)] = static_cast<float>(rng.between(-100.0, 900.0));
        }
        data::update(pyramid, grid, {min, max});
        ASSERT_TRUE(is_same(pyramid, data::make_height_pyramid(grid, 1))) << i;
    }
}

}  // namespace
