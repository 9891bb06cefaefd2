// Lines of sight against brute force over all triangles of a grid; voids, borders, ends on the ground, batches.
#include "data/line_of_sight.h"

#include <gtest/gtest.h>

#include <cstring>

#include "data/ground_height.h"
#include "tests/data/sight_lines.h"

namespace {

using data::HeightGrid;
using data::Sight;
using data::WorldLine;

using test::kTouch_m;
using test::look;
using test::random_line;

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

}  // namespace
