// What lies in the pool after any number of changes is what would be written from scratch, triangle by triangle in
// the same order; and what a frame writes follows what it changed.
#include <gtest/gtest.h>

#include "lod/scheduler.h"
#include "terrain/roam_front.h"
#include "tests/terrain/drawn_mesh.h"
#include "tests/terrain/test_relief.h"

namespace {

using terrain_test::DrawnTriangle;
using terrain_test::fractal_grid;
using terrain_test::level_view;

/// A front whose pool is kept, in a place of its own that does not begin at 0.
struct Rig {
    explicit Rig(const data::HeightGrid& grid, uint64_t reserve, int batch = 0)
        : front(terrain::make_diamond_table(grid, 2),
                {.tolerance_px = 1.0, .reserve_triangles = reserve, .batch = batch}) {}

    uint64_t adapt(const lod::View& view, double tolerance_px, uint64_t operations,
                   uint64_t most = UINT64_MAX) {
        lod::Front* fronts[] = {&front};
        front.begin_frame({&view, 1}, 0.0);
        const lod::Budget budget{.tolerance_px = tolerance_px, .max_triangles = most};
        return lod::schedule(fronts, budget, lod::operation_limit(operations)).operations;
    }

    /// What the pool holds of one view, after this view's writes.
    std::vector<DrawnTriangle> draw(const lod::View& view) {
        const lod::PoolRegion need = front.pool_need();
        if (need.vertex_capacity > region.vertex_capacity || need.index_capacity > region.index_capacity) {
            region = {77, need.vertex_capacity, 1001, need.index_capacity};
            front.place(region);
        }
        list.clear();
        front.emit(view, list);
        for (const lod::IndexWrite& write : list.index_writes) {
            EXPECT_GE(write.first_index, region.first_index);
            EXPECT_LE(write.first_index + write.indices.size(), region.first_index + region.index_capacity);
        }
        pool.apply(list);
        return terrain_test::drawn_triangles(pool, list, lod::Module::kTerrain);
    }

    /// The same from a pool that knows nothing yet.
    std::vector<DrawnTriangle> draw_anew(const lod::View& view) {
        region = front.pool_need();
        front.place(region);
        pool = {};
        return draw(view);
    }

    uint64_t indices_written() const {
        uint64_t count = 0;
        for (const lod::IndexWrite& write : list.index_writes)
            count += write.indices.size();
        return count;
    }

    terrain::RoamFront front;
    lod::PoolRegion region;
    terrain_test::PoolTwin pool;
    lod::DrawList list;
};

/// From so far above that nothing is culled.
lod::View from_above(const data::HeightGrid& grid, double spacing_m) {
    const double x = grid.width * spacing_m / 2.0, y = grid.height * spacing_m / 2.0;
    return level_view({x, y, 4.0 * (x + y) + 5000.0}, 0.0, -1.5707963);
}

bool are_same(const std::vector<DrawnTriangle>& a, const std::vector<DrawnTriangle>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& left, const auto& right) {
        return left.samples == right.samples && left.world == right.world;
    });
}

/// Random views, sometimes near each other, sometimes not; random interruptions, so that regions grow and shrink.
void compare_with_scratch(const data::HeightGrid& grid, double spacing_m, int frames, uint64_t seed,
                          int batch = 0) {
    Rig kept(grid, 0, batch), anew(grid, 0, batch);
    const lod::View above = from_above(grid, spacing_m);
    lod::Rng rng(seed);
    lod::View view = above;
    for (int frame = 0; frame < frames; ++frame) {
        if (frame % 12 == 0) {
            view = level_view({rng.between(0.0, 1.0) * grid.width * spacing_m,
                               rng.between(0.0, 1.0) * grid.height * spacing_m, rng.between(50, 900)},
                              rng.between(0.0, 6.3), rng.between(-1.0, 0.1));
        }
        view.eye_world += glm::dvec3(rng.between(-9, 9), rng.between(-9, 9), 0.0);
        const double tolerance_px = std::exp2(rng.between(-1.0, 3.0));
        const uint64_t operations = rng.below(600), most = 50 + rng.below(9000);
        kept.adapt(view, tolerance_px, operations, most);
        anew.adapt(view, tolerance_px, operations, most);
        ASSERT_EQ(kept.front.hash(), anew.front.hash());
        const auto drawn = kept.draw(above);
        ASSERT_TRUE(are_same(drawn, anew.draw_anew(above))) << "frame " << frame;
        ASSERT_EQ(drawn.size(), kept.front.emitted_triangles());
    }
    EXPECT_GT(kept.front.operations()[lod::OperationKind::kEnhMerge], 0u);
    EXPECT_GT(kept.front.operations()[lod::OperationKind::kForcedSplit], 0u);
}

TEST(IndexRuns, KeptIsWhatWouldBeWrittenFromScratch) {
    compare_with_scratch(fractal_grid(513, 513, 8.0, 400.0, 1), 8.0, 300, 31);
    compare_with_scratch(fractal_grid(300, 171, 10.0, 300.0, 2), 10.0, 300, 32);
}

TEST(IndexRuns, PatchesKeptAreWhatWouldBeWrittenFromScratch) {
    for (const int batch : {1, 2, 3}) {
        SCOPED_TRACE(batch);
        compare_with_scratch(fractal_grid(300, 171, 10.0, 300.0, 2), 10.0, 200, 34, batch);
    }
}

/// Drawing only now and then, and more than one view a frame, changes nothing.
TEST(IndexRuns, FramesThatNobodyDrawsAreMadeUpFor) {
    const data::HeightGrid grid = fractal_grid(513, 513, 8.0, 400.0, 3);
    Rig kept(grid, 20'000), anew(grid, 20'000);
    const lod::View above = from_above(grid, 8.0);
    lod::Rng rng(33);
    for (int frame = 0; frame < 120; ++frame) {
        const double t = frame / 60.0;
        const lod::View view = level_view({500.0 + 300.0 * t, 700.0 + 200.0 * t, 420.0}, 0.9 + 0.3 * t, -0.2);
        kept.adapt(view, 1.0, 400);
        anew.adapt(view, 1.0, 400);
        if (rng.unit() < 0.7) continue;
        kept.draw(view);
        const auto drawn = kept.draw(above);
        ASSERT_EQ(kept.indices_written(), 0u) << "the second view of a frame";
        ASSERT_TRUE(are_same(drawn, anew.draw_anew(above))) << "frame " << frame;
    }
}

/// The gate of emit's cost: exact counts over a flight of 100 m/s at 60 Hz.
TEST(IndexRuns, AFlightWritesWhatItChanges) {
    const data::HeightGrid grid = fractal_grid(1025, 1025, 10.0, 900.0, 1);
    Rig rig(grid, 100'000);
    const auto view_at = [&](int frame) {
        const double s = 100.0 / 60.0 * frame;
        return level_view({2000.0 + 0.6 * s, 2000.0 + 0.8 * s, double(grid.max_m) + 150.0}, 0.6435, -0.15);
    };
    rig.adapt(view_at(0), 0.5, UINT64_MAX);
    rig.draw(view_at(0));
    uint64_t operations = 0, written = 0, vertices = 0, most = 0;
    constexpr int kFrames = 120;
    for (int frame = 1; frame <= kFrames; ++frame) {
        operations += rig.adapt(view_at(frame), 0.5, UINT64_MAX);
        rig.draw(view_at(frame));
        written += rig.indices_written();
        most = std::max(most, rig.indices_written());
        for (const lod::VertexWrite& write : rig.list.vertex_writes)
            vertices += write.vertices.size();
    }
    const double all = 3.0 * double(rig.front.emitted_triangles());
    std::printf(
        "%.0f indices drawn, %.1f operations a frame: %.0f indices (%.2f %%, most %.1f %%), %.1f vertices "
        "written, %zu items\n",
        all, double(operations) / kFrames, double(written) / kFrames, 100.0 * double(written) / kFrames / all,
        100.0 * double(most) / all, double(vertices) / kFrames, rig.list.items.size());
    EXPECT_LT(double(written) / kFrames, 0.15 * all);
    EXPECT_LE(vertices, operations);
    EXPECT_LE(rig.list.items.size(), 32u);

    rig.adapt(view_at(kFrames), 0.5, UINT64_MAX);
    rig.draw(view_at(kFrames));
    EXPECT_EQ(rig.indices_written(), 0u) << "standing still";
    EXPECT_TRUE(rig.list.vertex_writes.empty());
}

}  // namespace
