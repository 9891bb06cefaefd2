// The painted ground: light falls where the sun is, whatever the number of threads or the texture's size.
#include "sim/ground_texture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "data/fractal_grid.h"
#include "lod/base/rng.h"
#include "sim/relief.h"
#include "sim/street_cover.h"
#include "sim/sunlight.h"

namespace {

constexpr double kSpacing_m = 30.0;

template <typename Height>
data::HeightGrid make_grid(int width, int height, const Height& height_at) {
    std::vector<float> heights;
    for (int row = 0; row < height; ++row) {
        for (int col = 0; col < width; ++col)
            heights.push_back(static_cast<float>(height_at(col, row)));
    }
    return data::make_planar_grid(width, height, kSpacing_m, heights);
}

data::HeightGrid rough_grid(int width, int height) {
    lod::Rng rng(1);
    return make_grid(width, height, [&](int, int) { return rng.between(100.0, 160.0); });
}

struct Rgb {
    double red = 0.0, green = 0.0, blue = 0.0;
    double sum() const { return red + green + blue; }
};

/// Mean over a rectangle given in shares of the picture.
Rgb mean(const data::Image& image, double left, double right) {
    Rgb rgb;
    double count = 0.0;
    for (int y = image.height / 4; y < image.height * 3 / 4; ++y) {
        for (int x = static_cast<int>(left * image.width); x < static_cast<int>(right * image.width); ++x) {
            const uint8_t* p = &image.rgba[(static_cast<size_t>(y) * static_cast<size_t>(image.width) +
                                            static_cast<size_t>(x)) *
                                           4];
            rgb.red += p[0];
            rgb.green += p[1];
            rgb.blue += p[2];
            count += 1.0;
        }
    }
    return {rgb.red / count, rgb.green / count, rgb.blue / count};
}

TEST(Sunlight, ComesFromTheEastSouthEastAtUnitLength) {
    EXPECT_NEAR(glm::length(sim::kSunEnu), 1.0, 1e-12);
    EXPECT_GT(sim::kSunEnu.x, 0.0);
    EXPECT_LT(sim::kSunEnu.y, 0.0);
}

TEST(GroundTexture, SlopesTowardsTheSunAreBrighter) {
    const auto ridge = make_grid(101, 101, [](int col, int) { return 300.0 - std::abs(col - 50) * 12.0; });
    const data::Image image = sim::paint_ground(ridge, {}, {101, 8192, 2});
    EXPECT_GT(mean(image, 0.6, 0.9).sum(), 1.25 * mean(image, 0.1, 0.4).sum());
}

TEST(GroundTexture, IsTheSameOnAnyNumberOfThreads) {
    const data::HeightGrid grid = rough_grid(83, 61);
    const data::Image one = sim::paint_ground(grid, {}, {300, 8192, 1});
    const data::Image three = sim::paint_ground(grid, {}, {300, 8192, 3});
    EXPECT_EQ(one.rgba, three.rgba);
}

TEST(GroundTexture, SizesFollowTheOptions) {
    const data::HeightGrid grid = rough_grid(90, 60);
    const auto size = [&](int detail_px, int max_px) {
        const data::Image image = sim::paint_ground(grid, {}, {detail_px, max_px, 2});
        EXPECT_EQ(image.rgba.size(),
                  static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * 4);
        return std::pair(image.width, image.height);
    };
    EXPECT_EQ(size(90, 8192), std::pair(90, 60));
    EXPECT_EQ(size(300, 8192), std::pair(270, 180));
    EXPECT_EQ(size(90, 45), std::pair(45, 30));
    EXPECT_EQ(size(90, 50), std::pair(45, 30));
}

TEST(GroundTexture, HalfTheSizeIsTheAverage) {
    const data::HeightGrid grid = rough_grid(64, 64);
    const data::Image full = sim::paint_ground(grid, {}, {64, 8192, 1});
    const data::Image half = sim::paint_ground(grid, {}, {64, 32, 1});
    ASSERT_EQ(half.width, 32);
    for (size_t y = 0; y < 32; ++y) {
        for (size_t x = 0; x < 32; ++x) {
            const auto texel = [&](size_t col, size_t row) {
                return int{full.rgba[(row * 64 + col) * 4 + 1]};
            };
            const int sum = texel(2 * x, 2 * y) + texel(2 * x + 1, 2 * y) + texel(2 * x, 2 * y + 1) +
                            texel(2 * x + 1, 2 * y + 1);
            EXPECT_NEAR(half.rgba[(y * 32 + x) * 4 + 1], sum / 4.0, 1.0);
        }
    }
}

TEST(GroundTexture, SeaIsBlueAndLandIsNot) {
    const auto coast =
        make_grid(120, 120, [](int col, int row) { return col < 60 ? 0.0 : 5.0 + (col + row) % 3; });
    const data::Image image = sim::paint_ground(coast, {}, {120, 8192, 2});
    const Rgb sea = mean(image, 0.05, 0.4), land = mean(image, 0.6, 0.95);
    EXPECT_GT(sea.blue, 1.2 * sea.red);
    EXPECT_GT(land.green, land.blue);
}

TEST(GroundTexture, SnowLiesOnlyHigh) {
    const auto low = make_grid(40, 40, [](int col, int row) { return 200.0 + (col * 7 + row) % 5; });
    const auto high = make_grid(40, 40, [](int col, int row) { return 4300.0 + (col * 7 + row) % 5; });
    EXPECT_LT(mean(sim::paint_ground(low, {}, {40, 8192, 1}), 0.1, 0.9).blue, 150.0);
    EXPECT_GT(mean(sim::paint_ground(high, {}, {40, 8192, 1}), 0.1, 0.9).blue, 190.0);
}

TEST(GroundTexture, ImageryCoversWhereItIsOpaque) {
    const auto flat = make_grid(64, 64, [](int, int) { return 100.0; });
    data::Image photo{64, 64, std::vector<uint8_t>(64 * 64 * 4, 0)};
    for (size_t y = 0; y < 64; ++y) {
        for (size_t x = 32; x < 64; ++x) {
            uint8_t* p = &photo.rgba[(y * 64 + x) * 4];
            p[0] = 200;
            p[2] = 40;
            p[3] = 255;
        }
    }
    const data::Image image = sim::paint_ground(flat, photo, {64, 8192, 1});
    const Rgb covered = mean(image, 0.6, 0.9), bare = mean(image, 0.1, 0.4);
    EXPECT_NEAR(covered.red, 200.0, 6.0);  // level ground keeps the photograph's own light
    EXPECT_NEAR(covered.green, 0.0, 2.0);
    EXPECT_GT(bare.green, 40.0);
}

/// A street along a row of the grid, in its own plane coordinates.
data::Street street_along(const data::HeightGrid& grid, double row, double width_m) {
    const auto site = [&](double col) {
        const data::SitePoint at = grid.frame.site_from_grid(col, row);
        return glm::dvec2(at.x, at.y);
    };
    return {{site(10.0), site(50.0)}, width_m};
}

TEST(StreetCover, IsTheShareOfEachTexel) {
    const auto flat = make_grid(64, 64, [](int, int) { return 100.0; });
    const std::vector<data::Street> streets{street_along(flat, 20.0, 12.0)};
    const sim::StreetCover same =
        sim::cover_streets(streets, flat, {64, 64});  // texels of 30 m on the samples
    EXPECT_NEAR(same.at(30, 20), 12.0 / 30.0, 0.003);
    EXPECT_EQ(same.at(30, 19), 0.0f);
    EXPECT_EQ(same.at(30, 21), 0.0f);
    EXPECT_EQ(same.at(5, 20), 0.0f);
    const sim::StreetCover fine = sim::cover_streets(streets, flat, {640, 640});  // 3 m; middle at 204.5
    double sum = 0.0;
    for (int y = 195; y < 215; ++y)
        sum += double{fine.at(300, y)};
    EXPECT_NEAR(sum, 12.0 / 3.0, 0.02) << "nothing is lost";
    EXPECT_EQ(fine.at(300, 204), 1.0f);
    EXPECT_EQ(fine.at(300, 205), 1.0f);
    EXPECT_EQ(fine.at(300, 198), 0.0f);
}

TEST(StreetCover, WhatLeavesTheGridIsCut) {
    const auto flat = make_grid(8, 8, [](int, int) { return 100.0; });
    const std::vector<data::Street> streets{{{{-1e6, -1e6}, {1e6, 1e6}}, 9.0},
                                            {{{1e7, 0.0}, {1e7, 5.0}}, 9.0}};
    const sim::StreetCover cover = sim::cover_streets(streets, flat, {32, 32});
    EXPECT_LE(cover.size.x, 32);
    EXPECT_EQ(sim::cover_streets({}, flat, {32, 32}).size.x, 0);
}

TEST(GroundTexture, StreetsAreGreyAndHaveLittleFineStructure) {
    const auto flat = make_grid(64, 64, [](int, int) { return 100.0; });
    const std::vector<data::Street> streets{street_along(flat, 20.0, 90.0)};
    sim::GroundTextureOptions options{64, 8192, 1};
    options.streets = streets;
    const data::Image image = sim::paint_ground(flat, {}, options);
    const auto texel = [&](size_t x, size_t y) { return &image.rgba[(y * 64 + x) * 4]; };
    const uint8_t* street = texel(30, 20);
    EXPECT_NEAR(street[0], street[1], 12);
    EXPECT_NEAR(street[1], street[2], 12);
    EXPECT_LT(street[3], 128);
    EXPECT_EQ(texel(30, 40)[3], 255);
}

TEST(GroundTexture, OneSampleIsEnough) {
    const data::Image image = sim::paint_ground(make_grid(1, 1, [](int, int) { return 10.0; }), {}, {});
    EXPECT_GE(image.width, 1);
    EXPECT_GE(image.height, 1);
}

TEST(Relief, ShadowFallsAwayFromTheSunAsFarAsTheTangentSays) {
    constexpr double kWall_m = 300.0;
    const auto wall = make_grid(200, 200, [](int col, int) { return col == 120 ? kWall_m : 0.0; });
    const sim::Relief relief = sim::measure_relief(wall, 2);
    const auto seen = [&](int col) { return int{relief.sunlight[wall.index(col, 100)]}; };
    const double reach_cells = kWall_m / kSpacing_m * sim::kSunEast / sim::kSunUp;  // along the columns
    EXPECT_EQ(seen(121), 255);
    EXPECT_EQ(seen(120), 255);
    EXPECT_EQ(seen(119), 0);
    EXPECT_EQ(seen(120 - static_cast<int>(reach_cells) + 2), 0);
    EXPECT_EQ(seen(120 - static_cast<int>(reach_cells) - 2), 255);
}

TEST(Relief, ProminenceIsHeightAboveTheMeanAround) {
    const auto hill = make_grid(201, 201, [](int col, int row) {
        return 500.0 * std::exp(-((col - 100) * (col - 100) + (row - 100) * (row - 100)) / 300.0);
    });
    const sim::Relief relief = sim::measure_relief(hill, 2);
    EXPECT_GT(relief.prominence_m[hill.index(100, 100)], 200.0f);
    EXPECT_LT(relief.prominence_m[hill.index(100, 130)], 0.0f);
    EXPECT_NEAR(relief.prominence_m[hill.index(5, 5)], 0.0f, 0.1f);
}

TEST(Relief, ShoreDistanceGrowsOutToSea) {
    const auto coast = make_grid(300, 5, [](int col, int) { return col < 280 ? 0.0 : 10.0; });
    const sim::Relief relief = sim::measure_relief(coast, 1);
    ASSERT_FALSE(relief.shore.empty());
    const auto shore = [&](int col) { return int{relief.shore[coast.index(col, 2)]}; };
    EXPECT_EQ(shore(290), 255);
    EXPECT_EQ(shore(279), 255);  // not level with its neighbours: the beach
    EXPECT_EQ(shore(278), 1);
    EXPECT_EQ(shore(270), 9);
    EXPECT_EQ(shore(3), 254);
    EXPECT_TRUE(sim::measure_relief(rough_grid(10, 10), 1).shore.empty());
}

/// After an edit the changed samples' texels, and those their land shades, are what a painting from scratch makes of
/// them; nothing outside the returned rectangle is touched.
TEST(GroundRepaint, IsThePaintingFromScratchWhereItMatters) {
    for (const int max_px : {8192, 100}) {  // finer and coarser than the samples
        sim::GroundTextureOptions options;
        options.detail_px = 600;
        options.max_px = max_px;
        data::HeightGrid grid = data::fractal_grid(201, 150, kSpacing_m, 300.0, 4);
        for (float& height : grid.height_m)
            height += 400.0f;
        grid.max_m += 400.0f;
        grid.min_m += 400.0f;
        data::Image image = sim::paint_ground(grid, {}, options);
        const data::Image before = image;
        data::HeightBlock block = data::make_block(
            grid,
            data::Crater{.centre_grid = {90.0, 70.0}, .radius_m = 300.0, .depth_m = 80.0, .rim_m = 60.0});
        data::exchange(grid, block);
        const sim::TexelRect rect = sim::repaint_ground(grid, {}, options, block, image);
        const data::Image anew = sim::paint_ground(grid, {}, options);
        const double texels = double(image.width) / grid.width;
        int changed = 0;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const size_t at = (size_t(y) * size_t(image.width) + size_t(x)) * 4;
                const bool is_in =
                    x >= rect.x && x < rect.x + rect.width && y >= rect.y && y < rect.y + rect.height;
                const bool is_changed_ground =
                    x > block.range.min.x * texels && x < block.range.max.x * texels &&
                    y > block.range.min.y * texels && y < block.range.max.y * texels;
                ASSERT_TRUE(is_in || !is_changed_ground);
                for (size_t c = 0; c < 4; ++c) {
                    if (is_in) {
                        ASSERT_NEAR(image.rgba[at + c], anew.rgba[at + c], 1) << x << ", " << y;
                    } else {
                        ASSERT_EQ(image.rgba[at + c], before.rgba[at + c]) << x << ", " << y;
                        // Prominence of the land around is not painted again: small.
                        ASSERT_NEAR(image.rgba[at + c], anew.rgba[at + c], 12) << x << ", " << y;
                    }
                    changed += std::abs(image.rgba[at + c] - before.rgba[at + c]) > 20 ? 1 : 0;
                }
            }
        }
        EXPECT_GT(changed, 50);
    }
}

}  // namespace
