// Heights and lines of sight do not know what is drawn: the same bits at every step of a flight; and at full
// resolution what is drawn is what they speak of.
#include <gtest/gtest.h>

#include <cstring>

#include "data/ground_query.h"
#include "data/line_of_sight.h"
#include "lod/scheduler.h"
#include "terrain/roam_front.h"
#include "tests/terrain/test_relief.h"
#include "tests/terrain/vertical_probe.h"

namespace {

struct Answers {
    std::vector<double> numbers;
    bool operator==(const Answers& other) const {
        return numbers.size() == other.numbers.size() &&
               std::memcmp(numbers.data(), other.numbers.data(), numbers.size() * sizeof(double)) == 0;
    }
};

Answers ask(const data::HeightGrid& grid, const data::HeightPyramid& pyramid) {
    Answers answers;
    lod::Rng rng(3);
    for (int i = 0; i < 50; ++i) {
        const data::WorldLine line{{rng.between(0, 1280), rng.between(0, 1280), rng.between(50, 400)},
                                   {rng.between(0, 1280), rng.between(0, 1280), rng.between(50, 400)}};
        const data::GroundAnswer ground = data::ground_under(grid, line.from);
        const data::Sight sight = data::line_of_sight(grid, pyramid, line);
        answers.numbers.insert(
            answers.numbers.end(),
            {ground.height_m, ground.normal_world.x, ground.normal_world.y, ground.normal_world.z,
             sight.share, sight.end_world.x, sight.end_world.y, sight.end_world.z});
    }
    return answers;
}

TEST(QueryInFlight, SameBitsForAnyCameraBudgetAndLevel) {
    const data::HeightGrid grid = terrain_test::fractal_grid(129, 129, 10.0, 400.0, 2);
    const data::HeightPyramid pyramid = data::make_height_pyramid(grid, 1);
    const Answers before = ask(grid, pyramid);
    terrain::RoamFront front(terrain::make_diamond_table(grid, 1), {.tolerance_px = 1.0});
    lod::Front* fronts[] = {&front};
    uint64_t least = UINT64_MAX, most = 0;
    for (int frame = 0; frame < 60; ++frame) {
        const lod::View view =
            terrain_test::level_view({640.0 + 9.0 * frame, 300.0 + 12.0 * frame, 500.0}, 0.3 * frame, -0.4);
        front.begin_frame({&view, 1}, frame / 60.0);
        lod::schedule(fronts, {.tolerance_px = frame % 3 == 0 ? 0.5 : 20.0},
                      lod::operation_limit(static_cast<uint64_t>(frame) * 17 % 400));
        least = std::min(least, front.triangles());
        most = std::max(most, front.triangles());
        ASSERT_TRUE(ask(grid, pyramid) == before) << frame;
    }
    EXPECT_GT(most, 2 * least) << "the front did not change";
}

TEST(QueryInFlight, IsTheMeshDrawnAtFullResolution) {
    const data::HeightGrid grid = terrain_test::fractal_grid(41, 33, 10.0, 150.0, 4);
    terrain::RoamFront front(terrain::make_diamond_table(grid, 1), {.tolerance_px = 0.0});
    lod::Front* fronts[] = {&front};
    lod::View view = terrain_test::level_view({200.0, 160.0, 900.0}, 0.0, -1.5707963);
    front.begin_frame({&view, 1}, 0.0);
    lod::schedule(fronts, {.tolerance_px = 0.0}, lod::operation_limit(UINT64_MAX));
    terrain_test::PoolTwin pool;
    const auto drawn = terrain_test::emit_triangles(front, view, pool);
    ASSERT_EQ(drawn.size(), 2u * 40u * 32u);
    const terrain_test::VerticalProbe probe(grid.width, grid.height, 10.0, drawn);
    lod::Rng rng(5);
    for (int i = 0; i < 2000; ++i) {
        const double col = rng.between(0.0, 40.0), row = rng.between(0.0, 32.0);
        const glm::dvec3 at = grid.frame.world_from_grid(col, row, 0.0);
        terrain_test::VerticalHit hit;  // the nearest sample may lie in the next triangle
        for (const glm::ivec2 corner : {glm::ivec2(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
            const int x = std::min(static_cast<int>(col) + corner.x, 40),
                      y = std::min(static_cast<int>(row) + corner.y, 32);
            const terrain_test::VerticalHit one = probe.probe(x, y, at, {0.0, 0.0, 1.0});
            if (one.found && one.beside_m < hit.beside_m) hit = one;
        }
        ASSERT_EQ(hit.beside_m, 0.0) << col << ' ' << row;
        ASSERT_NEAR(hit.above_m, data::ground_under(grid, at).height_m, 1e-3) << col << ' ' << row;
    }
}

}  // namespace
