// Edits of relief: what they change, what they leave alone, and that what is derived from the ground follows.
#include "data/relief_edit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "data/fractal_grid.h"
#include "data/ground_height.h"
#include "data/height_extremes.h"
#include "data/height_pyramid.h"
#include "data/line_of_sight.h"
#include "lod/base/rng.h"

namespace {

using data::HeightBlock;
using data::HeightGrid;

HeightGrid slope(int width, int height, double spacing_m) {
    std::vector<float> heights;
    for (int row = 0; row < height; ++row) {
        for (int col = 0; col < width; ++col)
            heights.push_back(static_cast<float>(100.0 + 0.5 * col));
    }
    return data::make_planar_grid(width, height, spacing_m, std::move(heights));
}

TEST(ReliefEdit, ASecondExchangeUndoesTheFirst) {
    HeightGrid grid = data::fractal_grid(60, 50, 5.0, 80.0, 3);
    grid.is_void.assign(grid.height_m.size(), 0);
    grid.is_void[grid.index(31, 22)] = 1;
    const HeightGrid before = grid;
    HeightBlock block{{{20, 15}, {40, 30}}, std::vector<float>(21 * 16, -500.0f)};
    data::exchange(grid, block);
    for (int row = 0; row < grid.height; ++row) {
        for (int col = 0; col < grid.width; ++col) {
            const bool is_in = col >= 20 && col <= 40 && row >= 15 && row <= 30 && !(col == 31 && row == 22);
            ASSERT_EQ(grid.at(col, row), is_in ? -500.0f : before.at(col, row)) << col << ", " << row;
        }
    }
    EXPECT_EQ(grid.min_m, -500.0f);
    EXPECT_EQ(grid.max_m, before.max_m);
    EXPECT_EQ(grid.is_void, before.is_void);
    data::exchange(grid, block);
    EXPECT_EQ(grid.height_m, before.height_m);
}

TEST(ReliefEdit, ACraterIsABowlWithARim) {
    const HeightGrid before = slope(201, 201, 2.0);
    HeightGrid grid = before;
    HeightBlock block = data::make_block(
        grid, data::Crater{.centre_grid = {100.0, 90.0}, .radius_m = 40.0, .depth_m = 15.0, .rim_m = 3.0});
    data::exchange(grid, block);
    const auto rise_m = [&](int col, int row) { return double(grid.at(col, row) - before.at(col, row)); };
    EXPECT_NEAR(rise_m(100, 90), -15.0, 1e-4);
    EXPECT_NEAR(rise_m(120, 90), 3.0, 1e-4);                // 40 m east
    EXPECT_NEAR(rise_m(100, 80), 3.0 - 18.0 * 0.75, 1e-4);  // 20 m north
    EXPECT_NEAR(rise_m(130, 90), 3.0 / 8.0, 1e-4);          // 60 m east
    for (int row = 0; row < 201; ++row) {
        for (int col = 0; col < 201; ++col) {
            const double r = 2.0 * std::hypot(col - 100.0, row - 90.0);
            if (r >= 80.0) {
                ASSERT_EQ(grid.at(col, row), before.at(col, row));
            }
            ASSERT_LE(rise_m(col, row), 3.0 + 1e-4);
        }
    }
    EXPECT_LE(block.range.columns(), 81);
    EXPECT_GE(block.range.columns(), 77);
}

TEST(ReliefEdit, AnExcavationHasAFlatFloorAndHeapsNothingUp) {
    const HeightGrid before = data::fractal_grid(150, 150, 2.0, 60.0, 9);
    HeightGrid grid = before;
    const data::Excavation pit{
        .centre_grid = {70.0, 80.0}, .radius_m = 30.0, .depth_m = 10.0, .slope_rad = std::atan(0.5)};
    const double floor_m = double(before.at(70, 80)) - 10.0;
    HeightBlock block = data::make_block(grid, pit);
    data::exchange(grid, block);
    for (int row = 0; row < 150; ++row) {
        for (int col = 0; col < 150; ++col) {
            const double r = 2.0 * std::hypot(col - 70.0, row - 80.0);
            const double side_m = floor_m + std::max(r - 30.0, 0.0) * 0.5;
            ASSERT_NEAR(double(grid.at(col, row)), std::min(double(before.at(col, row)), side_m), 1e-3);
        }
    }
}

TEST(ReliefEdit, OutsideTheRasterThereIsNothingToEdit) {
    const HeightGrid grid = slope(50, 40, 2.0);
    EXPECT_TRUE(data::make_block(grid, data::Crater{.centre_grid = {-200.0, 10.0}}).range.is_empty());
    EXPECT_TRUE(data::make_block(grid, data::Excavation{.centre_grid = {-1.0, 10.0}}).range.is_empty());
    const HeightBlock corner =
        data::make_block(grid, data::Crater{.centre_grid = {-10.0, -10.0}, .radius_m = 30.0});
    EXPECT_EQ(corner.range.min, glm::ivec2(0, 0));
    EXPECT_GT(corner.range.count(), 50u);
}

TEST(ReliefEdit, AnotherRasterGivesItsHeights) {
    const HeightGrid before = slope(80, 60, 10.0);
    HeightGrid other = data::fractal_grid(41, 31, 10.0, 50.0, 4);
    // Its sample (0, 0) lies on the grid's (20, 10): x = 200, y = 490.
    other.frame = *data::GroundFrame::make({195.0, 10.0, 0.0, 495.0, 0.0, -10.0}, "", 41, 31);
    other.is_void.assign(other.height_m.size(), 0);
    other.is_void[other.index(7, 9)] = 1;
    HeightGrid grid = before;
    HeightBlock block = data::make_block(grid, other);
    data::exchange(grid, block);
    for (int row = 0; row < 60; ++row) {
        for (int col = 0; col < 80; ++col) {
            const bool is_in = col >= 20 && col <= 60 && row >= 10 && row <= 40;
            const bool is_hole = col == 27 && row == 19;
            const float expected = is_in && !is_hole ? other.at(col - 20, row - 10) : before.at(col, row);
            ASSERT_EQ(grid.at(col, row), expected) << col << ", " << row;
        }
    }
    // Half a cell off: the surface between its samples.
    other.is_void.clear();
    other.frame = *data::GroundFrame::make({200.0, 10.0, 0.0, 495.0, 0.0, -10.0}, "", 41, 31);
    grid = before;
    block = data::make_block(grid, other);
    data::exchange(grid, block);
    EXPECT_EQ(grid.at(30, 20), static_cast<float>(data::ground_height(other, 9.5, 10.0).height_m));
}

bool is_same(const data::HeightExtremes& a, const data::HeightExtremes& b) {
    if (a.levels.size() != b.levels.size()) return false;
    for (size_t i = 0; i < a.levels.size(); ++i) {
        for (size_t j = 0; j < a.levels[i].blocks.size(); ++j) {
            const auto &left = a.levels[i].blocks[j], &right = b.levels[i].blocks[j];
            if (left.min_m != right.min_m || left.max_m != right.max_m || left.any_valid != right.any_valid ||
                left.any_void != right.any_void)
                return false;
        }
    }
    return true;
}

TEST(HeightExtremes, AreThoseOfTheSamples) {
    HeightGrid grid = data::fractal_grid(77, 50, 5.0, 80.0, 3);
    grid.is_void.assign(grid.height_m.size(), 0);
    for (int i = 0; i < 40; ++i)
        grid.is_void[grid.index(i, i / 2)] = 1;
    const data::HeightExtremes extremes = data::make_height_extremes(grid, 2);
    for (const auto& level : extremes.levels) {
        for (int row = 0; row < level.rows; ++row) {
            for (int col = 0; col < level.columns; ++col) {
                data::HeightExtremes::Block truth{1e9f, -1e9f, false, false};
                for (int y = row << level.shift; y < std::min((row + 1) << level.shift, 50); ++y) {
                    for (int x = col << level.shift; x < std::min((col + 1) << level.shift, 77); ++x) {
                        truth.min_m = std::min(truth.min_m, grid.at(x, y));
                        truth.max_m = std::max(truth.max_m, grid.at(x, y));
                        (grid.void_at(x, y) ? truth.any_void : truth.any_valid) = true;
                    }
                }
                const auto& found = level.blocks[level.index(col, row)];
                ASSERT_EQ(found.min_m, truth.min_m);
                ASSERT_EQ(found.max_m, truth.max_m);
                ASSERT_EQ(found.any_valid, truth.any_valid);
                ASSERT_EQ(found.any_void, truth.any_void);
            }
        }
    }
}

/// What skips by the ground, after an edit, is what it would be made of the edited ground; and so are its answers.
TEST(ReliefEdit, WhatIsDerivedFollows) {
    HeightGrid grid = data::fractal_grid(130, 95, 5.0, 80.0, 6);
    data::HeightExtremes extremes = data::make_height_extremes(grid, 1);
    data::HeightPyramid pyramid = data::make_height_pyramid(grid, 1);
    lod::Rng rng(1);
    int changed_sights = 0;
    for (int round = 0; round < 30; ++round) {
        const data::WorldLine line{{rng.between(20, 600), rng.between(20, 440), 60.0},
                                   {rng.between(20, 600), rng.between(20, 440), 60.0}};
        const data::Sight before = data::line_of_sight(grid, pyramid, line);
        HeightBlock block =
            data::make_block(grid, data::Crater{.centre_grid = {rng.between(0, 130), rng.between(0, 95)},
                                                .radius_m = rng.between(5.0, 100.0),
                                                .depth_m = 20.0,
                                                .rim_m = 30.0});
        data::exchange(grid, block);
        data::update(extremes, grid, block.range);
        data::update(pyramid, grid, block.range);
        ASSERT_TRUE(is_same(extremes, data::make_height_extremes(grid, 3)));
        const data::Sight now = data::line_of_sight(grid, pyramid, line);
        const data::Sight anew = data::line_of_sight(grid, data::make_height_pyramid(grid, 1), line);
        ASSERT_EQ(now.is_blocked, anew.is_blocked);
        ASSERT_EQ(now.share, anew.share);
        changed_sights += before.is_blocked != now.is_blocked ? 1 : 0;
    }
    EXPECT_GT(changed_sights, 0);
}

}  // namespace
