// A table brought up to date after an edit is the table built anew, fact by fact; and what that costs follows the edit.
#include "terrain/table_edit.h"

#include <gtest/gtest.h>

#include "data/relief_edit.h"
#include "tests/terrain/test_relief.h"

namespace {

/// Index of the first fact in which two tables differ; their size when they agree.
size_t first_difference(const terrain::DiamondTable& a, const terrain::DiamondTable& b) {
    for (size_t i = 0; i < a.slots.size(); ++i) {
        const terrain::DiamondSource &left = a.slots[i], &right = b.slots[i];
        if (left.height_m != right.height_m || left.error_code != right.error_code ||
            left.rise_and_voids != right.rise_and_voids)
            return i;
    }
    return a.slots.size();
}

void expect_same(const terrain::DiamondTable& edited, const terrain::DiamondTable& anew) {
    ASSERT_EQ(edited.slots.size(), anew.slots.size());
    EXPECT_EQ(first_difference(edited, anew), anew.slots.size());
    for (int corner = 0; corner < 4; ++corner) {
        EXPECT_EQ(edited.corners[corner].height_m, anew.corners[corner].height_m);
        EXPECT_EQ(edited.corners[corner].rise_and_voids, anew.corners[corner].rise_and_voids);
    }
    EXPECT_LE(edited.min_m, anew.min_m);
    EXPECT_GE(edited.max_m, anew.max_m);
}

/// Holes of any shape, some of them larger than a search's smallest block.
void dig_holes(data::HeightGrid& grid, lod::Rng& rng) {
    grid.is_void.assign(grid.height_m.size(), 0);
    for (int hole = 0; hole < 6; ++hole) {
        const int x0 = static_cast<int>(rng.below(static_cast<uint64_t>(grid.width)));
        const int y0 = static_cast<int>(rng.below(static_cast<uint64_t>(grid.height)));
        const int size = 1 + static_cast<int>(rng.below(30));
        for (int y = y0; y < std::min(y0 + size, grid.height); ++y) {
            for (int x = x0; x < std::min(x0 + size, grid.width); ++x)
                grid.is_void[grid.index(x, y)] = 1;
        }
    }
}

data::HeightBlock random_block(const data::HeightGrid& grid, lod::Rng& rng) {
    const auto below = [&](int n) { return static_cast<int>(rng.below(static_cast<uint64_t>(n))); };
    data::HeightBlock block;
    const int largest = 1 << below(7);
    block.range.min = {below(grid.width), below(grid.height)};
    block.range.max = glm::min(block.range.min + glm::ivec2(below(largest), below(largest)),
                               glm::ivec2(grid.width - 1, grid.height - 1));
    const float lift_m = static_cast<float>(below(3) - 1) * 100.0f;
    for (int y = block.range.min.y; y <= block.range.max.y; ++y) {
        for (int x = block.range.min.x; x <= block.range.max.x; ++x)
            block.height_m.push_back(grid.at(x, y) * 0.5f + lift_m + static_cast<float>(below(1000)) * 0.01f);
    }
    return block;
}

struct Edited {
    explicit Edited(data::HeightGrid of)
        : grid(std::move(of)),
          extremes(data::make_height_extremes(grid, 2)),
          table(terrain::make_diamond_table(grid, 2)) {}

    terrain::TableEditCounts exchange(data::HeightBlock& block, unsigned threads) {
        data::exchange(grid, block);
        data::update(extremes, grid, block.range);
        return terrain::edit_table({grid, extremes, block.range}, table, threads);
    }

    data::HeightGrid grid;
    data::HeightExtremes extremes;
    terrain::DiamondTable table;
};

struct Size {
    int width, height;
};

class TableEdit : public testing::TestWithParam<Size> {};

TEST_P(TableEdit, IsTheTableBuiltAnew) {
    lod::Rng rng(uint64_t(GetParam().width));
    for (const bool has_holes : {false, true}) {
        data::HeightGrid grid =
            terrain_test::fractal_grid(GetParam().width, GetParam().height, 10.0, 300.0, 5);
        if (has_holes) dig_holes(grid, rng);
        Edited edited(std::move(grid));
        for (int round = 0; round < 20; ++round) {
            SCOPED_TRACE(testing::Message() << "holes " << has_holes << ", round " << round);
            data::HeightBlock block = random_block(edited.grid, rng);
            edited.exchange(block, 1 + unsigned(round) % 3);
            expect_same(edited.table, terrain::make_diamond_table(edited.grid, 2));
            if (round % 3 != 0 || HasFailure()) continue;
            edited.exchange(block, 2);  // undone
            expect_same(edited.table, terrain::make_diamond_table(edited.grid, 2));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, TableEdit,
                         testing::Values(Size{129, 129}, Size{300, 170}, Size{257, 513}, Size{2, 2},
                                         Size{3, 90}),
                         [](const testing::TestParamInfo<Size>& size) {
                             return std::to_string(size.param.width) + "x" +
                                    std::to_string(size.param.height);
                         });

/// Grids on the Earth add what chords lose, which depends on the planes.
TEST(TableEditOnEarth, IsTheTableBuiltAnew) {
    data::HeightGrid grid = terrain_test::fractal_grid(260, 200, 1.0, 900.0, 8);
    const double degree = 1.0 / 1200.0;
    grid.frame = *data::GroundFrame::make({-121.9, degree, 0.0, 46.9, 0.0, -degree}, "EPSG:4326", 260, 200);
    Edited edited(std::move(grid));
    lod::Rng rng(4);
    for (int round = 0; round < 10; ++round) {
        data::HeightBlock block = random_block(edited.grid, rng);
        edited.exchange(block, 2);
        expect_same(edited.table, terrain::make_diamond_table(edited.grid, 2));
    }
}

/// The same crater in the middle of grids of 16 times the samples: a few diamonds a level more, and searches that look
/// at a small share of what they cover.
TEST(TableEditCost, FollowsTheRegionNotTheGrid) {
    terrain::TableEditCounts counts[2];
    for (int i = 0; i < 2; ++i) {
        const int side = i == 0 ? 513 : 2049;
        Edited edited(terrain_test::fractal_grid(side, side, 1.0, 0.08 * side, 3));
        data::Crater crater;
        crater.centre_grid = {side / 2 + 13, side / 2 - 21};
        crater.radius_m = 40.0;
        crater.depth_m = 12.0;
        crater.rim_m = 2.0;
        data::HeightBlock block = data::make_block(edited.grid, crater);
        counts[i] = edited.exchange(block, 2);
        RecordProperty("computed_" + std::to_string(side), std::to_string(counts[i].computed));
        RecordProperty("searched_" + std::to_string(side), std::to_string(counts[i].searched_samples));
        EXPECT_LT(counts[i].computed, 2 * block.range.count());
        EXPECT_LT(counts[i].searched_samples, uint64_t(side) * uint64_t(side));
    }
    EXPECT_LE(counts[1].computed, counts[0].computed + 4 * 8);  // four levels more
    EXPECT_LT(counts[1].searched_samples, 3 * counts[0].searched_samples);
}

}  // namespace
