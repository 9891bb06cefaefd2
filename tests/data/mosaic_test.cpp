#include "data/height_grid.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "tests/data/relief.h"

namespace {

using data::HeightGrid;
using test::count_voids;
using test::expect_invariants;
using test::expect_relief;
using test::failure;
using test::RasterSpec;
using test::read;
using test::relief;
using test::relief_spec;

// Rectangle [col, col + width) x [row, row + height) of the relief on a grid of 0.01 degrees from 7 E, 44 N.
std::string tile(const std::string& name, glm::ivec2 at, glm::ivec2 size) {
    return test::write_raster(
        name, relief_spec(size.x, size.y, {7 + 0.01 * at.x, 0.01, 0, 44 - 0.01 * at.y, 0, -0.01}));
}

TEST(Mosaic, TilesThatShareAnEdgeJoinWithoutSeam) {
    const HeightGrid grid = read({tile("a.tif", {0, 0}, {21, 21}), tile("b.tif", {20, 0}, {21, 21}),
                                  tile("c.tif", {0, 20}, {21, 21})});
    ASSERT_EQ(grid.width, 41);
    ASSERT_EQ(grid.height, 41);
    EXPECT_EQ(count_voids(grid), 400u);  // the fourth quarter
    expect_relief(grid, 1e-3);
}

TEST(Mosaic, PixelIsAreaNeighboursMeet) {
    const HeightGrid grid = read({tile("a.tif", {20, 10}, {20, 20}), tile("b.tif", {0, 10}, {20, 20}),
                                  tile("c.tif", {0, 0}, {40, 10})});
    ASSERT_EQ(grid.width, 40);
    ASSERT_EQ(grid.height, 30);
    EXPECT_FALSE(grid.has_voids());
    expect_relief(grid, 1e-3);
    EXPECT_NEAR(grid.frame.site_from_grid(0, 0).x, 7.005, 1e-9);
}

TEST(Mosaic, TheFirstListedWinsWhereItIsValid) {
    RasterSpec low{.width = 4, .height = 4, .values = std::vector<double>(16, 1.0)};
    low.values[5] = -32768;
    RasterSpec high{.width = 4, .height = 4, .values = std::vector<double>(16, 2.0)};
    const HeightGrid grid = read({test::write_raster("low.tif", low), test::write_raster("high.tif", high)});
    EXPECT_EQ(grid.at(0, 0), 1.0f);
    EXPECT_EQ(grid.at(1, 1), 2.0f);
    EXPECT_FALSE(grid.has_voids());
}

TEST(Mosaic, OtherSpacingPhaseAndCrsAreResampled) {
    const std::string first = tile("a.tif", {0, 0}, {60, 60});
    const std::string fine =
        test::write_raster("fine.tif", relief_spec(220, 240, {7.5033, 0.0027, 0, 43.9951, 0, -0.0027}));
    const HeightGrid grid = read({first, fine});
    EXPECT_GT(grid.width, 100);
    expect_relief(grid, 5.0);  // a step of the relief between samples is up to 30 m

    // The same ground in UTM: heights by the relief at each sample's longitude and latitude.
    RasterSpec utm{
        .width = 150, .height = 90, .geo_transform = {330000, 500, 0, 4872000, 0, -500}, .crs = "EPSG:32632"};
    const auto frame = data::GroundFrame::make(utm.geo_transform, utm.crs, utm.width, utm.height);
    for (int row = 0; row < utm.height; ++row) {
        for (int col = 0; col < utm.width; ++col) {
            const data::SitePoint site = frame->site_from_grid(col, row);
            utm.values.push_back(relief(site.x, site.y));
        }
    }
    const HeightGrid mixed = read({first, test::write_raster("utm.tif", utm)});
    EXPECT_GT(mixed.width, 90);  // the first ends at 7.6 E, the second beyond 7.9
    expect_relief(mixed, 9.0);   // the outermost half cell takes the border's height
    // No gap where the two meet: every sample between their middles is valid.
    EXPECT_FALSE(mixed.void_at(mixed.width / 2, mixed.height / 2));
}

TEST(Mosaic, ResamplingNeverMixesVoidsIn) {
    RasterSpec spec = relief_spec(40, 40, {7.6, 0.01, 0, 44.003, 0, -0.01});
    for (size_t i = 0; i < spec.values.size(); i += 7)
        spec.values[i] = i % 2 ? -32768.0 : -9999.0;
    const HeightGrid grid = read({tile("a.tif", {0, 0}, {60, 40}), test::write_raster("gaps.tif", spec)});
    EXPECT_GT(count_voids(grid), 100u);
    expect_invariants(grid);
    EXPECT_GT(grid.min_m, 100.0f);
    expect_relief(grid, 20.0);  // one-sided near a void
}

TEST(Mosaic, TilesJoinAcrossTheAntimeridian) {
    const HeightGrid grid =
        read({test::write_raster("fiji_w.tif", relief_spec(11, 11, {179.895, 0.01, 0, -16, 0, -0.01})),
              test::write_raster("fiji_e.tif", relief_spec(11, 11, {-180.005, 0.01, 0, -16, 0, -0.01}))});
    EXPECT_EQ(grid.width, 21);
    EXPECT_EQ(grid.height, 11);
    EXPECT_FALSE(grid.has_voids());
}

TEST(Mosaic, JoiningRefusesWhatDoesNotBelongTogether) {
    RasterSpec planar = relief_spec(5, 5, {0, 1, 0, 0, 0, -1});
    planar.crs.clear();
    EXPECT_NE(
        failure({tile("a.tif", {0, 0}, {9, 9}), test::write_raster("planar.tif", planar)}).find("no CRS"),
        std::string::npos);
    const std::string tiny = test::write_raster("tiny.tif", relief_spec(9, 9, {7, 1e-6, 0, 44, 0, -1e-6}));
    EXPECT_NE(failure({tiny, tile("a.tif", {0, 0}, {900, 9})}).find("at most"), std::string::npos);
}

TEST(Mosaic, RealTilesCutAndJoinedAreTheWhole) {
    const std::string path = test::real_data("monaco/N43E007.hgt.zip");
    if (!test::exists(path)) GTEST_SKIP() << "no shared/data beside the project";
    const HeightGrid whole = read({path});
    std::vector<std::string> quarters;
    for (int k = 0; k < 4; ++k) {
        const int col = k % 2 * 600, row = k / 2 * 600;
        RasterSpec spec{.width = 601, .height = 601, .type = GDT_Int16};
        spec.geo_transform = {7 + (col - 0.5) / 1200, 1.0 / 1200, 0, 44 - (row - 0.5) / 1200, 0, -1.0 / 1200};
        for (int y = row; y <= row + 600; ++y) {
            for (int x = col; x <= col + 600; ++x)
                spec.values.push_back(whole.void_at(x, y) ? -32768.0 : double{whole.at(x, y)});
        }
        quarters.push_back(test::write_raster("quarter" + std::to_string(k) + ".tif", spec));
    }
    const HeightGrid joined = read(quarters);
    EXPECT_EQ(joined.height_m, whole.height_m);
    EXPECT_EQ(joined.is_void, whole.is_void);
    EXPECT_EQ(joined.frame.world_from_sample(700, 800, 0), whole.frame.world_from_sample(700, 800, 0));
}

}  // namespace
