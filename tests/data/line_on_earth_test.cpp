// Lines of sight over the curved Earth: anywhere on it, over real relief, against thousands of points along each line.
#include <gtest/gtest.h>

#include "tests/data/sight_lines.h"

namespace {

using data::HeightGrid;
using data::Sight;
using data::WorldLine;
using test::expect_on_ground;
using test::kTouch_m;
using test::look;
using test::random_line;

/// A place on the Earth and how long the lines are.
struct Area {
    const char* name;
    std::array<double, 6> geo_transform;
    double relief_m, length_cells;
    double noise_m = 2 * kTouch_m;  ///< in the twin; a step from the pole a nanometre is degrees of longitude
};

class LineOnEarth : public testing::TestWithParam<Area> {};

/// Clearance at thousands of points, by GeographicLib, the geotransform and the twin of the surface.
double lowest_sampled_m(const HeightGrid& grid, const std::array<double, 6>& g, const WorldLine& line,
                        int count) {
    double lowest = INFINITY;
    for (int k = 0; k <= count; ++k) {
        const glm::dvec3 p = test::twin_place(g, grid.width, glm::mix(line.from, line.to, double(k) / count));
        const test::TwinHeight ground = test::twin_height(grid, p.x, p.y);
        if (ground.is_inside && !ground.is_void) lowest = std::min(lowest, p.z - ground.height_m);
    }
    return lowest;
}

TEST_P(LineOnEarth, IsWhatSamplingAlongItSays) {
    const Area& area = GetParam();
    const HeightGrid grid = test::rough_grid(60, 50, area.geo_transform, "EPSG:4326", area.relief_m);
    const data::HeightPyramid pyramid = data::make_height_pyramid(grid, 1);
    lod::Rng rng(9);
    int blocked = 0, clear = 0, unsure = 0;
    for (int i = 0; i < 400; ++i) {
        const WorldLine line = random_line(grid, rng, area.length_cells, area.relief_m);
        const Sight sight = data::line_of_sight(grid, pyramid, line);
        const double lowest_m = lowest_sampled_m(grid, area.geo_transform, line, 2000);
        if (lowest_m < -area.noise_m) {
            ASSERT_TRUE(sight.is_blocked) << i << ": " << lowest_m;
            // Nothing is blocked before, and at that point the ground is met, or entered from its border.
            const WorldLine before{line.from, glm::mix(line.from, line.to, sight.share * (1.0 - 1e-9))};
            if (sight.share > 0.0) {
                ASSERT_GE(lowest_sampled_m(grid, area.geo_transform, before, 500), -area.noise_m) << i;
                expect_on_ground(grid, test::twin_place(area.geo_transform, grid.width, sight.end_world),
                                 area.noise_m);
            }
            ++blocked;
        } else if (!sight.is_blocked) {
            ++clear;
        } else {
            // Samples can miss a summit: what the line hits must be there.
            expect_on_ground(grid, test::twin_place(area.geo_transform, grid.width, sight.end_world),
                             area.noise_m);
            ++unsure;
        }
        const Sight back = data::line_of_sight(grid, pyramid, {line.to, line.from});
        ASSERT_EQ(back.is_blocked, sight.is_blocked) << "seeing is mutual";
        if (sight.is_blocked) {
            ASSERT_LE(sight.share, 1.0 - back.share + 1e-12);
        }
    }
    EXPECT_GT(blocked, 40);
    EXPECT_GT(clear, 40);
    EXPECT_LT(unsure, 20);
}

INSTANTIATE_TEST_SUITE_P(
    Areas, LineOnEarth,
    testing::Values(Area{"alps", {7.0, 0.001, 0.0, 44.0, 0.0, -0.001}, 300.0, 40.0},
                    Area{"coarse", {10.0, 0.05, 0.0, 50.0, 0.0, -0.05}, 3000.0, 30.0},
                    Area{"antimeridian", {179.97, 0.001, 0.0, -17.0, 0.0, -0.001}, 300.0, 40.0},
                    Area{"world", {-180.0, 6.0, 0.0, 84.0, 0.0, -3.0}, 200000.0, 3.0},
                    Area{"near_pole", {20.0, 0.5, 0.0, 89.99, 0.0, -0.0005}, 300.0, 30.0},
                    Area{"over_pole", {-180.0, 6.0, 0.0, 90.00025, 0.0, -0.0005}, 300.0, 40.0, 1e-4}),
    [](const auto& one) { return one.param.name; });

TEST(LineOfSight, CurvesWithTheEarth) {
    // The sea, 1 degree square: from 2 m above it the horizon is 5.05 km away, and as far again for the other end.
    const std::array<double, 6> g = {0.0, 0.01, 0.0, 45.0, 0.0, -0.01};
    HeightGrid sea = test::rough_grid(100, 100, g, "EPSG:4326", 0.0);
    const auto buoy = [&](double longitude) {
        return sea.frame.world().world_from_site({longitude, 44.5, 2.0});
    };
    EXPECT_FALSE(look(sea, {buoy(0.2), buoy(0.2 + 10.0 / 79.5)}).is_blocked);
    const Sight beyond = look(sea, {buoy(0.2), buoy(0.2 + 10.3 / 79.5)});
    EXPECT_TRUE(beyond.is_blocked);
    // A chord of length L lies s (L - s) / 2R lower than its ends: 2 m at the first place that is blocked.
    const double half_m = 0.5 * glm::distance(buoy(0.2), buoy(0.2 + 10.3 / 79.5)), kRadius_m = 6388.6e3;
    EXPECT_NEAR(glm::distance(beyond.end_world, buoy(0.2)),
                half_m - std::sqrt(half_m * half_m - 4.0 * kRadius_m), 5.0);
    EXPECT_FALSE(
        look(sea, {buoy(0.5), sea.frame.world().world_from_site({3.0, 30.0, 20'200'000.0})}).is_blocked)
        << "a satellite";
    EXPECT_TRUE(
        look(sea, {buoy(0.5), sea.frame.world().world_from_site({100.0, -60.0, 20'200'000.0})}).is_blocked)
        << "one below the horizon";
}

TEST(LineOfSight, GoesRoundTheEarth) {
    // A belt around the equator: plains, and a wall of 10 km along its first column, or its last.
    const auto belt = [](int width, double first_longitude, int wall) {
        const std::array<double, 6> g = {first_longitude - 0.25, 0.5, 0.0, 2.0, 0.0, -0.5};
        HeightGrid grid = test::rough_grid(width, 8, g, "EPSG:4326", 0.0);
        for (int row = 0; row < 8; ++row)
            grid.height_m[grid.index(wall, row)] = 10'000.0f;
        return grid;
    };
    const auto at = [](double longitude, double latitude, double height_m) {
        return data::WorldFrame{}.world_from_site({longitude, latitude, height_m});
    };
    // Samples from -179.75 to 179.75: a cell is missing between.
    for (const int wall : {0, 719}) {
        const Sight over = look(belt(720, -179.75, wall), {at(179.6, 0.1, 2000), at(-179.6, 0.1, 2000)});
        EXPECT_TRUE(over.is_blocked) << wall;
        const Sight back = look(belt(720, -179.75, wall), {at(-179.6, 0.1, 2000), at(179.6, 0.1, 2000)});
        EXPECT_TRUE(back.is_blocked) << wall;
    }
    EXPECT_FALSE(look(belt(720, -179.75, 300), {at(179.6, 0.1, 2000), at(-179.6, 0.1, 2000)}).is_blocked);
    // Samples from -180 to 180: along the seam.
    HeightGrid seam = belt(721, -180.0, 0);
    for (int row = 0; row < 8; ++row)
        seam.height_m[seam.index(720, row)] = 10'000.0f;
    for (const double longitude : {180.0, -180.0, 179.9999999, -179.9999999}) {
        EXPECT_TRUE(look(seam, {at(longitude, 0.1, 9'000), at(longitude, 0.6, 9'000)}).is_blocked)
            << longitude;
        EXPECT_FALSE(look(seam, {at(longitude, 0.1, 11'000), at(longitude, 0.6, 11'000)}).is_blocked);
    }
}

TEST(LineOfSight, IsMutualToTheLastBit) {
    const HeightGrid grid =
        test::rough_grid(60, 50, {7.0, 0.001, 0.0, 44.0, 0.0, -0.001}, "EPSG:4326", 300.0);
    const data::HeightPyramid pyramid = data::make_height_pyramid(grid, 1);
    lod::Rng rng(12);
    int turned = 0;
    for (int i = 0; i < 60; ++i) {
        const WorldLine line = random_line(grid, rng, 30.0, 100.0);
        const glm::dvec3 up = glm::normalize(line.from);
        const auto raised = [&](double by_m) {
            return WorldLine{line.from + up * by_m, line.to + up * by_m};
        };
        const auto is_blocked = [&](const WorldLine& l) {
            return data::line_of_sight(grid, pyramid, l).is_blocked;
        };
        double low_m = 0.0, high_m = 1000.0;  // to where it just sees
        if (!is_blocked(raised(low_m)) || is_blocked(raised(high_m))) continue;
        for (int step = 0; step < 45; ++step) {
            const double middle_m = 0.5 * (low_m + high_m);
            (is_blocked(raised(middle_m)) ? low_m : high_m) = middle_m;
        }
        for (double off_m = -3e-8; off_m <= 3e-8; off_m += 1e-10) {
            const WorldLine one = raised(low_m + off_m);
            ASSERT_EQ(is_blocked(one), is_blocked({one.to, one.from})) << i << ' ' << off_m;
        }
        ++turned;
    }
    EXPECT_GT(turned, 20);
}

/// Real relief, any raster: clearance by the frame's own way to the grid.
void expect_like_sampling(const std::string& name, double length_cells) {
    const std::string path = std::string(HARRIER_SOURCE_DIR) + "/../shared/data/terrain/" + name;
    const auto read = data::read_height_grid({path}, {.voids = data::VoidPolicy::kHole});
    if (!read) GTEST_SKIP() << read.message();
    const HeightGrid& grid = *read;
    const data::HeightPyramid pyramid = data::make_height_pyramid(grid, 2);
    lod::Rng rng(11);
    int blocked = 0, clear = 0;
    std::vector<glm::dvec3> points(1000);
    for (int i = 0; i < 300; ++i) {
        const WorldLine line = random_line(grid, rng, length_cells, 3000.0);
        for (size_t k = 0; k < points.size(); ++k)
            points[k] = glm::mix(line.from, line.to, double(k) / 999.0);
        grid.frame.grid_from_world(points);
        const Sight sight = data::line_of_sight(grid, pyramid, line);
        double lowest_m = INFINITY, lowest_before_m = INFINITY;
        for (size_t k = 0; k < points.size(); ++k) {
            const test::TwinHeight ground = test::twin_height(grid, points[k].x, points[k].y);
            if (!ground.is_inside || ground.is_void) continue;
            lowest_m = std::min(lowest_m, points[k].z - ground.height_m);
            if (double(k) / 999.0 < sight.share)
                lowest_before_m = std::min(lowest_before_m, points[k].z - ground.height_m);
        }
        if (lowest_m < -2 * kTouch_m) {
            ASSERT_TRUE(sight.is_blocked) << name << ' ' << i << ": " << lowest_m;
        }
        ASSERT_GE(lowest_before_m, -2 * kTouch_m) << name << ' ' << i << ": blocked before " << sight.share;
        (sight.is_blocked ? blocked : clear) += 1;
        if (!sight.is_blocked || sight.share == 0.0) continue;
        glm::dvec3 hit = sight.end_world;
        grid.frame.grid_from_world({&hit, 1});
        if (!grid.has_voids())
            expect_on_ground(grid, hit, 2 * kTouch_m);  // at a void's rim it is entered from its side, too
    }
    EXPECT_GT(blocked, 30);
    EXPECT_GT(clear, 30);
}

TEST(LineOfSight, RainierIsWhatSamplingSays) {
    expect_like_sampling("mt_rainier_90m.tif", 400.0);
}
TEST(LineOfSight, BigTujungaInUtmIsWhatSamplingSays) {
    expect_like_sampling("srtm_bigtujunga30m_utm11.tif", 300.0);
}
TEST(LineOfSight, GapsAreWhatSamplingSays) {
    expect_like_sampling("dem_gaps.tif", 100.0);
}
TEST(LineOfSight, AnOldDatumIsWhatSamplingSays) {
    expect_like_sampling("sfdem_declared_nodata.tif", 200.0);
}

}  // namespace
