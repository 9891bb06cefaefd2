// The front: valid after every operation, deterministic, coherent with brute-force twins.
#include "terrain/roam_front.h"

#include <gtest/gtest.h>

#include "lod/scheduler.h"
#include "tests/terrain/test_relief.h"

namespace {

using terrain_test::fractal_grid;
using terrain_test::level_view;

lod::View flight_view(int frame) {
    const double t = frame / 60.0;
    return level_view({200.0 + 100.0 * t, 300.0 + 40.0 * t, 260.0}, 0.8 + 0.1 * t, -0.1);
}

TEST(RoamFront, ValidAfterEveryOperationCount) {
    const data::HeightGrid grid = fractal_grid(257, 257, 4.0, 200.0, 1);
    terrain::RoamFront front(terrain::make_diamond_table(grid, 2), {.tolerance_px = 0.5});
    lod::Front* fronts[] = {&front};
    const lod::View view = flight_view(0);
    front.begin_frame({&view, 1}, 0.0);
    for (int op = 0; op < 3000; ++op) {
        ASSERT_EQ(front.validate(), "") << "after operation " << op;
        if (lod::schedule(fronts, {.tolerance_px = 0.5}, lod::operation_limit(1)).converged) break;
    }
}

TEST(RoamFront, RandomFlightStaysValid) {
    const data::HeightGrid grid = fractal_grid(200, 131, 10.0, 300.0, 2);
    terrain::RoamFront front(terrain::make_diamond_table(grid, 2), {.tolerance_px = 1.0});
    lod::Front* fronts[] = {&front};
    lod::Rng rng(7);
    for (int frame = 0; frame < 400; ++frame) {
        SCOPED_TRACE(frame);
        lod::View view = flight_view(frame);
        if (rng.unit() < 0.1)
            view = level_view({rng.between(0, 2000), rng.between(0, 1300), rng.between(50, 600)},
                              rng.between(0, 6.3), rng.between(-1.5, 0.5));
        front.begin_frame({&view, 1}, 0.0);
        lod::schedule(fronts, {.tolerance_px = 1.0, .max_triangles = 4000},
                      lod::operation_limit(rng.below(400)));
        ASSERT_EQ(front.validate(), "");
    }
}

TEST(RoamFront, ToleranceZeroIsTheFullMesh) {
    const data::HeightGrid grid = fractal_grid(100, 73, 10.0, 100.0, 3);
    terrain::RoamFront front(terrain::make_diamond_table(grid, 1), {.tolerance_px = 0.0});
    lod::Front* fronts[] = {&front};
    const lod::View view = level_view({495, 360, 3000}, 0.0, -1.5707963);
    front.begin_frame({&view, 1}, 0.0);
    EXPECT_TRUE(lod::schedule(fronts, {.tolerance_px = 0.0}, lod::operation_limit(10'000'000)).converged);
    EXPECT_EQ(front.error_px(), 0.0);
    front.place(front.pool_need());
    lod::DrawList list;
    front.emit(view, list);
    EXPECT_EQ(front.emitted_triangles(), 99u * 72u * 2u);
    EXPECT_EQ(front.validate(), "");
}

}  // namespace
