// Lines of sight against brute force: on a plane over all triangles of the grid, on the Earth at thousands of points
// along each line.
#include "data/line_of_sight.h"

#include <gtest/gtest.h>

#include <cstring>

#include "data/ground_height.h"
#include "tests/data/ground_twin.h"
#include "tests/data/relief.h"

namespace {

using data::HeightGrid;
using data::Sight;
using data::WorldLine;

constexpr double kTouch_m = 1e-6;

Sight look(const HeightGrid& grid, const WorldLine& line) {
    return data::line_of_sight(grid, data::make_height_pyramid(grid, 1), line);
}

/// The stretch of a line over one triangle, and the line's height above its plane at both ends of it.
struct Over {
    double begin = 0.0, end = 1.0, begin_m = 0.0, end_m = 0.0;
};

bool over_triangle(const std::array<glm::dvec3, 3>& t, const WorldLine& line, Over& out) {
    const auto turn = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& p) {
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    };
    const double area = turn(t[0], t[1], t[2]);
    out = {};
    double above_from = line.from.z, above_to = line.to.z;
    for (size_t k = 0; k < 3; ++k) {
        const auto &a = t[(k + 1) % 3], &b = t[(k + 2) % 3];
        const double from = turn(a, b, line.from) / area, to = turn(a, b, line.to) / area;
        above_from -= from * t[k].z;
        above_to -= to * t[k].z;
        if (from < 0.0 && to < 0.0) return false;
        if (from < 0.0) out.begin = std::max(out.begin, from / (from - to));
        if (to < 0.0) out.end = std::min(out.end, from / (from - to));
    }
    if (out.begin > out.end) return false;
    out.begin_m = above_from + (above_to - above_from) * out.begin;
    out.end_m = above_from + (above_to - above_from) * out.end;
    return true;
}

/// Every triangle of a planar grid: the lowest clearance, and the first share at which it is below the touch.
struct Brute {
    double lowest_m = INFINITY, first = 2.0;
};

Brute brute_force(const HeightGrid& grid, const WorldLine& line) {
    Brute out;
    for (int y = 0; y + 1 < grid.height; ++y) {
        for (int x = 0; x + 1 < grid.width; ++x) {
            const auto p = [&](int dx, int dy) {
                return grid.frame.world_from_grid(x + dx, y + dy, double{grid.at(x + dx, y + dy)});
            };
            const bool is_even = (x + y) % 2 == 0;
            const std::array<std::array<glm::dvec3, 3>, 2> halves =
                is_even ? std::array<std::array<glm::dvec3, 3>, 2>{{{p(0, 0), p(1, 1), p(1, 0)},
                                                                    {p(0, 0), p(1, 1), p(0, 1)}}}
                        : std::array<std::array<glm::dvec3, 3>, 2>{
                              {{p(1, 0), p(0, 1), p(0, 0)}, {p(1, 0), p(0, 1), p(1, 1)}}};
            Over over;
            for (const auto& half : halves) {
                if (!over_triangle(half, line, over)) continue;
                out.lowest_m = std::min({out.lowest_m, over.begin_m, over.end_m});
                const double a = over.begin_m + kTouch_m, b = over.end_m + kTouch_m;
                if (a >= 0.0 && b >= 0.0) continue;
                const double first =
                    a < 0.0 ? over.begin : over.begin + (over.end - over.begin) * a / (a - b);
                out.first = std::min(out.first, first);
            }
        }
    }
    return out;
}

TEST(LineOfSight, IsBruteForceOnAPlane) {
    const HeightGrid grid = test::rough_grid(24, 17, test::kPlanarTransform, "", 120.0);
    const data::HeightPyramid pyramid = data::make_height_pyramid(grid, 1);
    lod::Rng rng(1);
    int blocked = 0;
    for (int i = 0; i < 10'000; ++i) {
        const auto point = [&] {
            return glm::dvec3(rng.between(-40.0, 270.0), rng.between(300.0, 530.0),
                              rng.between(-10.0, 200.0));
        };
        WorldLine line{point(), point()};
        if (i % 7 == 0) line.to.x = line.from.x;
        if (i % 11 == 0) line.to.y = line.from.y;
        const Brute truth = brute_force(grid, line);
        const Sight sight = data::line_of_sight(grid, pyramid, line);
        if (std::abs(truth.lowest_m + kTouch_m) < 1e-8) continue;
        ASSERT_EQ(sight.is_blocked, truth.lowest_m < -kTouch_m) << i << ": " << truth.lowest_m;
        ASSERT_FALSE(sight.is_through_void);
        blocked += sight.is_blocked;
        if (!sight.is_blocked) {
            ASSERT_EQ(sight.share, 1.0);
            ASSERT_EQ(sight.end_world, line.to);
            continue;
        }
        ASSERT_NEAR(sight.share, truth.first, 1e-6) << i;
        ASSERT_LE(glm::distance(sight.end_world, glm::mix(line.from, line.to, sight.share)), 1e-9);
    }
    EXPECT_GT(blocked, 2000);
    EXPECT_LT(blocked, 8000);
}

TEST(LineOfSight, SeesWhatStandsOnTheGround) {
    const HeightGrid grid = test::rough_grid(24, 17, test::kPlanarTransform, "", 120.0);
    lod::Rng rng(2);
    for (int i = 0; i < 500; ++i) {
        const double col = rng.between(0.0, 23.0), row = rng.between(0.0, 16.0);
        const double ground_m = data::ground_height(grid, col, row).height_m;
        const auto at = [&](double above_m) {
            return grid.frame.world_from_grid(col, row, ground_m + above_m);
        };
        EXPECT_FALSE(look(grid, {at(300.0), at(0.0)}).is_blocked) << "from above on";
        EXPECT_FALSE(look(grid, {at(0.0), at(0.0)}).is_blocked) << "a point on the ground";
        EXPECT_TRUE(look(grid, {at(-1.0), at(-1.0)}).is_blocked) << "a point in the ground";
        const Sight into = look(grid, {at(300.0), at(-1.0)});
        EXPECT_TRUE(into.is_blocked);
        EXPECT_NEAR(into.share, 300.0 / 301.0, 1e-7);
        const Sight out_of = look(grid, {at(-1.0), at(300.0)});
        EXPECT_TRUE(out_of.is_blocked);
        EXPECT_EQ(out_of.share, 0.0);
    }
}

TEST(LineOfSight, VoidsLetItPassAndSaySo) {
    // A wall of 100 m across the middle, with a void gate in it.
    std::vector<float> heights(21 * 21, 0.0f);
    for (int row = 0; row < 21; ++row)
        heights[static_cast<size_t>(row) * 21 + 10] = 100.0f;
    HeightGrid grid = data::make_planar_grid(21, 21, 10.0, heights);
    grid.is_void.assign(heights.size(), 0);
    for (int row = 8; row <= 12; ++row) {
        for (int col = 9; col <= 11; ++col)
            grid.is_void[grid.index(col, row)] = 1;
    }
    const Sight wall = look(grid, {{5, 30, 50}, {195, 30, 50}});
    EXPECT_TRUE(wall.is_blocked);
    EXPECT_FALSE(wall.is_through_void);
    EXPECT_NEAR(wall.end_world.x, 95.0, 1e-4);
    const Sight gate = look(grid, {{5, 103, 50}, {195, 103, 50}});
    EXPECT_FALSE(gate.is_blocked);
    EXPECT_TRUE(gate.is_through_void);
    const Sight over_gate = look(grid, {{5, 103, 101}, {195, 103, 101}});
    EXPECT_FALSE(over_gate.is_blocked);
    EXPECT_FALSE(over_gate.is_through_void);
    const Sight before_wall = look(grid, {{5, 30, 50}, {90, 30, 50}});
    EXPECT_FALSE(before_wall.is_blocked);
}

TEST(LineOfSight, BeyondTheRasterNothingBlocks) {
    const HeightGrid grid = data::make_planar_grid(5, 5, 10.0, std::vector<float>(25, 30.0f));
    EXPECT_FALSE(look(grid, {{-100, 5, 10}, {-1, 5, 10}}).is_blocked);
    const Sight entering = look(grid, {{-100, 5, 10}, {20, 5, 10}});
    EXPECT_TRUE(entering.is_blocked) << "below the ground at the border";
    EXPECT_NEAR(entering.end_world.x, 0.0, 1e-6);
    EXPECT_FALSE(look(grid, {{-100, 5, 30}, {200, 5, 30}}).is_blocked) << "touching all along";
    EXPECT_FALSE(look(grid, {{-5, 3, 10}, {3, -5, 10}}).is_blocked) << "past the corner";
    EXPECT_FALSE(look(grid, {{-100, NAN, 10}, {20, 5, 10}}).is_blocked);
    EXPECT_FALSE(look(grid, {{-INFINITY, 5, 10}, {20, 5, 10}}).is_blocked);
}

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

/// A place (column, row, height) where a line is blocked: on the surface, or below it on the raster's border.
void expect_on_ground(const HeightGrid& grid, const glm::dvec3& p, double noise_m) {
    const glm::dvec2 inside =
        glm::clamp(glm::dvec2(p), glm::dvec2(0.0), glm::dvec2(grid.width - 1, grid.height - 1));
    ASSERT_LE(glm::distance(inside, glm::dvec2(p)), 1e-6);
    const double above_m = p.z - test::twin_height(grid, inside.x, inside.y).height_m;
    const glm::dvec2 to_border = glm::min(inside, glm::dvec2(grid.width - 1, grid.height - 1) - inside);
    ASSERT_LE(above_m, kTouch_m + noise_m);
    if (std::min(to_border.x, to_border.y) > 1e-6) {
        ASSERT_GE(above_m, -kTouch_m - noise_m);
    }
}

WorldLine random_line(const HeightGrid& grid, lod::Rng& rng, double length_cells, double above_m) {
    const double col = rng.between(0.0, grid.width - 1.0), row = rng.between(0.0, grid.height - 1.0);
    const double angle = rng.between(0.0, 6.283185);
    const auto end = [&](double c, double r) {
        const double ground_m = data::ground_height(grid, c, r).height_m;
        return grid.frame.world_from_grid(c, r, ground_m + std::exp(rng.between(-4.0, std::log(above_m))));
    };
    return {end(col, row), end(std::clamp(col + length_cells * std::cos(angle), 0.0, grid.width - 1.0),
                               std::clamp(row + length_cells * std::sin(angle), 0.0, grid.height - 1.0))};
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

TEST(LineOfSight, BatchesAreSingleAnswersForAnyThreads) {
    const HeightGrid grid =
        test::rough_grid(60, 50, {380000.0, 30.0, 0.0, 3800000.0, 0.0, -30.0}, "EPSG:32611", 300.0);
    const data::HeightPyramid pyramid = data::make_height_pyramid(grid, 1);
    lod::Rng rng(10);
    std::vector<WorldLine> lines;
    for (int i = 0; i < 500; ++i)
        lines.push_back(random_line(grid, rng, 30.0, 200.0));
    for (unsigned threads : {1u, 2u, 7u}) {
        std::vector<Sight> sights(lines.size());
        data::lines_of_sight(grid, pyramid, lines, sights, threads);
        for (size_t i = 0; i < lines.size(); ++i) {
            const Sight one = data::line_of_sight(grid, pyramid, lines[i]);
            ASSERT_EQ(sights[i].is_blocked, one.is_blocked);
            ASSERT_EQ(std::memcmp(&sights[i].share, &one.share, sizeof one.share), 0);
            ASSERT_EQ(sights[i].end_world, one.end_world);
        }
    }
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
