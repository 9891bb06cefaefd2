// A box contains its ground, and what it says of an eye's sight is true of every point inside: nothing visible is
// called hidden, nothing is nearer, and no displacement costs more pixels. The oracle is projection, point by point.
#include "terrain/rivals/ground_box.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/terrain/test_relief.h"

namespace {

using terrain::GridPatch;
using terrain::GroundBox;

double outside_m(const GroundBox& box, const glm::dvec3& world) {
    const glm::dvec3 local = glm::abs((world - box.centre) * box.axes) - box.half_m;
    return std::max({local.x, local.y, local.z});
}

TEST(GroundBox, ContainsEverySampleAndIsNoLargerThanNeeded) {
    const data::HeightGrid planar = terrain_test::fractal_grid(120, 90, 12.0, 400.0, 1);
    const auto real =
        data::read_height_grid({std::string(HARRIER_SOURCE_DIR) + "/data/samples/jacksboro.tif"}, {});
    ASSERT_TRUE(real) << real.message();
    lod::Rng rng(2);
    for (const data::HeightGrid* grid : {&planar, &*real}) {
        for (int i = 0; i < 60; ++i) {
            const int col = static_cast<int>(rng.below(static_cast<uint64_t>(grid->width - 1)));
            const int row = static_cast<int>(rng.below(static_cast<uint64_t>(grid->height - 1)));
            const GridPatch patch{col, row,
                                  std::min(col + 1 + static_cast<int>(rng.below(64)), grid->width - 1),
                                  std::min(row + 1 + static_cast<int>(rng.below(64)), grid->height - 1)};
            const GroundBox box = terrain::ground_box(*grid, patch);
            double worst = -1e9;
            for (int y = patch.min_row; y <= patch.max_row; ++y) {
                for (int x = patch.min_col; x <= patch.max_col; ++x)
                    worst = std::max(
                        worst, outside_m(box, grid->frame.world_from_sample(x, y, double(grid->at(x, y)))));
            }
            EXPECT_LE(worst, 1e-9);
            EXPECT_GE(worst, -3.0);  // what 64 chords of 90 m may bulge, and do not
        }
    }
}

TEST(GroundBox, SightIsTrueOfEveryPointInside) {
    const data::HeightGrid grid = terrain_test::fractal_grid(65, 65, 10.0, 300.0, 3);
    lod::Rng rng(4);
    size_t seen = 0, hidden = 0;
    double sharpest = 0.0;
    for (int i = 0; i < 4000; ++i) {
        const int col = static_cast<int>(rng.below(48)), row = static_cast<int>(rng.below(48));
        const GroundBox box = terrain::ground_box(grid, {col, row, col + 16, row + 16});
        const glm::dvec3 eye(rng.between(-300, 900), rng.between(-300, 900), rng.between(-200, 900));
        lod::View view = terrain_test::level_view(eye, rng.between(0.0, 6.3), rng.between(-1.5, 0.5));
        view.fov_y_rad = rng.between(0.2, 2.0);
        const lod::ViewMetric metric = lod::metric_of(view);
        const terrain::Sight sight = terrain::sight_of(metric, box);
        hidden += sight.is_visible() ? 0u : 1u;
        for (int k = 0; k < 20; ++k) {
            const glm::dvec3 inside =
                box.half_m * glm::dvec3(rng.between(-1, 1), rng.between(-1, 1), rng.between(-1, 1));
            const glm::dvec3 p = view.eye_from_world * (box.centre + box.axes * inside - eye);
            const double depth = -p.z;
            const bool is_seen = depth > metric.near_m && std::abs(p.x) < depth * metric.tan_x &&
                                 std::abs(p.y) < depth * metric.tan_y;
            if (!is_seen) continue;
            ++seen;
            ASSERT_TRUE(sight.is_visible());
            ASSERT_LE(sight.depth_m, depth * (1.0 + 1e-12));
            const double error_m = rng.between(0.0, 0.4) * sight.depth_m;
            const glm::dvec3 way =
                glm::normalize(glm::dvec3(rng.between(-1, 1), rng.between(-1, 1), rng.between(-1, 1)));
            const glm::dvec3 q = p + way * error_m;
            const double px = metric.lambda_px * std::hypot(p.x / depth + q.x / q.z, p.y / depth + q.y / q.z);
            ASSERT_LE(px, sight.error_px(error_m) * (1.0 + 1e-9));
            sharpest = std::max(sharpest, px / sight.error_px(error_m));
        }
    }
    EXPECT_GT(seen, 5000u);
    EXPECT_GT(hidden, 1000u);
    EXPECT_GT(sharpest, 0.8);
}

}  // namespace
