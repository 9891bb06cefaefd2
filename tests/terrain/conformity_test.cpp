// The drawn mesh has no T-junction and no gap, wherever refinement was interrupted. Judged on the integer grid
// coordinates of what the draw list holds, with no help from the mesh's own bookkeeping.
#include <gtest/gtest.h>

#include "lod/scheduler.h"
#include "terrain/roam_front.h"
#include "tests/terrain/conformity.h"
#include "tests/terrain/drawn_mesh.h"
#include "tests/terrain/test_relief.h"

namespace {

using terrain_test::DrawnTriangle;

/// Cuts a hole of voids into a grid.
void add_voids(data::HeightGrid& grid, int left, int top, int side) {
    grid.is_void.resize(grid.height_m.size(), 0);
    for (int row = top; row < top + side; ++row) {
        for (int col = left; col < left + side; ++col)
            grid.is_void[grid.index(col, row)] = 1;
    }
}

lod::View random_view(const data::HeightGrid& grid, double spacing_m, lod::Rng& rng) {
    const double width_m = grid.width * spacing_m, height_m = grid.height * spacing_m;
    const glm::dvec3 eye(rng.between(-0.2, 1.2) * width_m, rng.between(-0.2, 1.2) * height_m,
                         rng.between(0.0, 1.0) < 0.7 ? rng.between(100, 500) : rng.between(500, 6000));
    return terrain_test::level_view(eye, rng.between(0.0, 6.3), rng.between(-1.57, 0.3));
}

/// The whole raster from so far above that nothing is culled.
lod::View whole_view(const data::HeightGrid& grid, double spacing_m) {
    const glm::dvec2 middle(grid.width * spacing_m / 2.0, grid.height * spacing_m / 2.0);
    return terrain_test::level_view({middle.x, middle.y, 4.0 * (middle.x + middle.y) + 5000.0}, 0.0,
                                    -1.5707963);
}

std::vector<DrawnTriangle> drawn(lod::Front& front, const lod::View& view, terrain_test::PoolTwin& pool) {
    lod::DrawList list;
    front.emit(view, list);
    pool.apply(list);
    return terrain_test::drawn_triangles(pool, list, lod::Module::kTerrain);
}

/// Flies about at random, stops refinement anywhere, and looks at what would be drawn each time.
void fly_and_check(const data::HeightGrid& grid, double spacing_m, int frames, uint64_t seed, int batch = 0) {
    terrain::RoamFront front(terrain::make_diamond_table(grid, 2), {.tolerance_px = 1.0, .batch = batch});
    lod::Front* fronts[] = {&front};
    const lod::View whole = whole_view(grid, spacing_m);
    lod::Rng rng(seed);
    for (int frame = 0; frame < frames; ++frame) {
        SCOPED_TRACE("frame " + std::to_string(frame));
        const lod::View view = random_view(grid, spacing_m, rng);
        front.begin_frame({&view, 1}, 0.0);
        lod::Budget budget;
        budget.tolerance_px = std::exp2(rng.between(-2.0, 4.0));
        if (rng.unit() < 0.5) budget.max_triangles = 10 + rng.below(6000);
        lod::schedule(fronts, budget, lod::operation_limit(rng.below(rng.unit() < 0.5 ? 50 : 5000)));

        lod::PoolRegion region = front.pool_need();
        region.index_capacity *= 2;  // two views
        front.place(region);
        terrain_test::PoolTwin pool;
        ASSERT_EQ(terrain_test::conformity_fault(drawn(front, view, pool)), "");
        const std::vector<DrawnTriangle> all = drawn(front, whole, pool);
        ASSERT_EQ(terrain_test::conformity_fault(all), "");
        if (!grid.has_voids()) {
            ASSERT_EQ(terrain_test::area_of(all), int64_t{2} * (grid.width - 1) * (grid.height - 1));
        }
        ASSERT_EQ(front.validate(), "");
        if (grid.width == grid.height && front.mesh().domain().side() == grid.width - 1) {
            ASSERT_EQ(all.size(), front.triangles());
        }
    }
}

TEST(TerrainConformity, SquareRaster) {
    fly_and_check(terrain_test::fractal_grid(257, 257, 8.0, 300.0, 1), 8.0, 150, 11);
}

TEST(TerrainConformity, RasterOfAnySize) {
    fly_and_check(terrain_test::fractal_grid(200, 131, 10.0, 300.0, 2), 10.0, 150, 12);
    fly_and_check(terrain_test::fractal_grid(300, 5, 10.0, 300.0, 3), 10.0, 100, 13);
    fly_and_check(terrain_test::fractal_grid(2, 2, 10.0, 30.0, 4), 10.0, 10, 14);
    fly_and_check(terrain_test::fractal_grid(3, 18, 10.0, 30.0, 5), 10.0, 30, 15);
}

TEST(TerrainConformity, RasterWithHoles) {
    data::HeightGrid grid = terrain_test::fractal_grid(180, 180, 10.0, 300.0, 6);
    add_voids(grid, 40, 50, 37);
    add_voids(grid, 100, 120, 1);
    add_voids(grid, 170, 0, 10);
    fly_and_check(grid, 10.0, 150, 16);
}

/// Leaves drawn as patches, down to where the grid ends.
class TerrainConformityOf : public testing::TestWithParam<int> {};

TEST_P(TerrainConformityOf, Batches) {
    const int k = GetParam();
    fly_and_check(terrain_test::fractal_grid(129, 129, 8.0, 300.0, 1), 8.0, 60, 11, k);
    fly_and_check(terrain_test::fractal_grid(200, 131, 10.0, 300.0, 2), 10.0, 60, 12, k);
    fly_and_check(terrain_test::fractal_grid(2, 2, 10.0, 30.0, 4), 10.0, 10, 14, k);
    fly_and_check(terrain_test::fractal_grid(3, 18, 10.0, 30.0, 5), 10.0, 20, 15, k);
    data::HeightGrid holes = terrain_test::fractal_grid(150, 150, 10.0, 300.0, 6);
    add_voids(holes, 40, 50, 37);
    add_voids(holes, 100, 120, 1);
    add_voids(holes, 140, 0, 10);
    fly_and_check(holes, 10.0, 60, 16, k);
}

INSTANTIATE_TEST_SUITE_P(K, TerrainConformityOf, testing::Values(1, 2, 3));

}  // namespace
