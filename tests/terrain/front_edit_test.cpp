// A front over ground that changes under it: valid after every step, its bound true at once, judged by the edited grid
// and by what is drawn.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "data/relief_edit.h"
#include "lod/scheduler.h"
#include "terrain/roam_front.h"
#include "tests/terrain/conformity.h"
#include "tests/terrain/test_relief.h"

namespace {

using terrain_test::DrawnTriangle;

constexpr double kExtent_m = 2560.0, kRate = 60.0;

lod::View flight(int frame) {
    const double t = frame / kRate;
    return terrain_test::level_view({300.0 + 80.0 * t, 400.0 + 60.0 * t, 420.0}, 0.7 + 0.05 * t, -0.25);
}

/// @param centre  in shares of the grid
data::HeightBlock crater_at(const data::HeightGrid& grid, const glm::dvec2& centre, double radius_m) {
    data::Crater crater;
    crater.centre_grid = centre * double(grid.width - 1);
    crater.radius_m = radius_m;
    crater.depth_m = 0.4 * radius_m;
    crater.rim_m = 0.1 * radius_m;
    return data::make_block(grid, crater);
}

glm::dvec3 in_eye(const lod::View& view, const glm::dvec3& world) {
    return view.eye_from_world * (world - view.eye_world);
}
bool is_in_view(const lod::View& view, const glm::dvec3& world) {
    return lod::distance_outside_m(lod::metric_of(view), in_eye(view, world), 0.0) <= 0.0;
}
double apart_px(const lod::View& view, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 p = in_eye(view, a), q = in_eye(view, b);
    return lod::metric_of(view).lambda_px * glm::length(glm::dvec2(p) / -p.z - glm::dvec2(q) / -q.z);
}

/// Ground, front and what it drew last.
struct Rig {
    explicit Rig(double glide_s, unsigned threads = 2, int side = 129)
        : cell_m(kExtent_m / (side - 1)),
          grid(terrain_test::fractal_grid(side, side, cell_m, 400.0, 5)),
          extremes(data::make_height_extremes(grid, 2)),
          front(terrain::make_diamond_table(grid, 2),
                {.tolerance_px = 1.0, .threads = threads, .reserve_triangles = 60'000, .glide_s = glide_s}) {}

    terrain::FrontEditCounts edit(data::HeightBlock& block) {
        data::exchange(grid, block);
        data::update(extremes, grid, block.range);
        return front.edit({grid, extremes, block.range});
    }

    void frame(const lod::View& view, double time_s, uint64_t operations = UINT64_MAX) {
        lod::Front* fronts[] = {&front};
        front.begin_frame({&view, 1}, time_s);
        lod::schedule(fronts, {.tolerance_px = 1.0}, lod::operation_limit(operations));
        draw(view);
    }
    /// The mesh as it is, whatever its queues would do next.
    void look(const lod::View& view, double time_s) {
        front.begin_frame({&view, 1}, time_s);
        draw(view);
    }
    void draw(const lod::View& view) {
        const lod::PoolRegion need = front.pool_need();
        if (need.index_capacity > placed.index_capacity || need.vertex_capacity > placed.vertex_capacity) {
            placed = need;
            front.place(placed);
        }
        lod::DrawList list;
        front.emit(view, list);
        pool.apply(list);
        triangles = terrain_test::drawn_triangles(pool, list, lod::Module::kTerrain);
    }

    /// The largest distance on the screen between a sample of the grid and the drawn surface above or below it.
    double measured_px(const lod::View& view) const {
        double worst = 0.0;
        for (const DrawnTriangle& t : triangles) {
            terrain_test::for_each_sample(t, [&](int x, int y, const glm::dvec3& drawn) {
                const glm::dvec3 truth(x * cell_m, (grid.height - 1 - y) * cell_m, double(grid.at(x, y)));
                if (is_in_view(view, truth) && is_in_view(view, drawn))
                    worst = std::max(worst, apart_px(view, truth, drawn));
            });
        }
        return worst;
    }

    std::map<std::pair<int, int>, glm::dvec3> vertices() const {
        std::map<std::pair<int, int>, glm::dvec3> out;
        for (const DrawnTriangle& t : triangles) {
            for (size_t i = 0; i < 3; ++i)
                out[{t.samples[i].y, t.samples[i].x}] = t.world[i];
        }
        return out;
    }

    double cell_m;
    data::HeightGrid grid;
    data::HeightExtremes extremes;
    terrain::RoamFront front;
    terrain_test::PoolTwin pool;
    lod::PoolRegion placed;
    std::vector<DrawnTriangle> triangles;
};

TEST(FrontEdit, TheBoundIsTrueAtOnce) {
    for (const double glide_s : {0.0, 0.4}) {
        Rig rig(glide_s);
        for (int frame = 0; frame < 40; ++frame)
            rig.frame(flight(frame), frame / kRate);
        const lod::View view = flight(39);
        const double before_px = rig.front.error_px();
        const uint64_t hash = rig.front.hash();
        data::HeightBlock block = crater_at(rig.grid, {0.294, 0.698}, 300.0);
        ASSERT_GT(rig.edit(block).vertices, 20u);
        EXPECT_EQ(rig.front.validate(), "");
        EXPECT_EQ(rig.front.hash(), hash) << "the cut has not changed";
        rig.look(view, 39 / kRate);
        EXPECT_LE(rig.measured_px(view), rig.front.error_px() + 0.01);
        EXPECT_GT(rig.measured_px(view), before_px) << "the crater is nothing to the picture";
        rig.frame(view, 40 / kRate);
        EXPECT_LE(rig.measured_px(view), rig.front.error_px() + 0.01);
        for (int frame = 41; frame < 100; ++frame)
            rig.frame(view, frame / kRate);
        EXPECT_LE(rig.front.error_px(), 1.0);
        EXPECT_LE(rig.measured_px(view), 1.0);
        EXPECT_EQ(rig.front.validate(), "");
    }
}

/// Every drawn vertex of a settled front lies on the edited ground: none has been forgotten.
TEST(FrontEdit, VerticesLieOnTheNewGround) {
    Rig rig(0.0);
    lod::Rng rng(2);
    for (int round = 0; round < 8; ++round) {
        data::HeightBlock block = crater_at(rig.grid, {rng.unit(), rng.unit()}, 250.0);
        rig.edit(block);
        rig.frame(flight(5 * round), round / kRate);
        for (const auto& [key, world] : rig.vertices())
            ASSERT_NEAR(world.z, double(rig.grid.at(key.second, key.first)), 1e-3);
    }
}

TEST(FrontEdit, StaysValidUnderFireWhileGliding) {
    Rig rig(0.4);
    lod::Rng rng(7);
    std::vector<data::HeightBlock> done;
    for (int frame = 0; frame < 120; ++frame) {
        SCOPED_TRACE(frame);
        const lod::View view = flight(frame);
        rig.frame(view, frame / kRate, frame % 3 == 0 ? 40 : 4000);
        if (frame % 4 == 1) {
            done.push_back(crater_at(rig.grid, {rng.unit(), rng.unit()}, rng.between(15.0, 400.0)));
            rig.edit(done.back());
        } else if (frame % 8 == 7) {
            rig.edit(done.back());  // undone
            done.pop_back();
        } else {
            continue;
        }
        ASSERT_EQ(rig.front.validate(), "");
        rig.look(view, frame / kRate);
        ASSERT_EQ(terrain_test::conformity_fault(rig.triangles), "");
        ASSERT_LE(rig.measured_px(view), rig.front.error_px() + 0.01);
    }
}

/// The frame of an edit moves no vertex in view farther than the front says, and says more than nothing.
TEST(FrontEdit, TheJumpIsTold) {
    Rig rig(0.4);
    for (int frame = 0; frame < 40; ++frame)
        rig.frame(flight(frame), frame / kRate);
    const lod::View view = flight(40);
    const auto before = rig.vertices();
    data::HeightBlock block = crater_at(rig.grid, {0.294, 0.698}, 200.0);
    rig.edit(block);
    rig.look(view, 40 / kRate);  // nothing is refined: what moves, the edit has moved
    double moved_px = 0.0;
    for (const auto& [key, world] : rig.vertices()) {
        const auto was = before.find(key);
        if (was != before.end() && is_in_view(view, world) && is_in_view(view, was->second))
            moved_px = std::max(moved_px, apart_px(view, world, was->second));
    }
    EXPECT_GT(moved_px, 10.0);
    EXPECT_LE(moved_px, rig.front.jump_px());
    EXPECT_LT(rig.front.jump_px(), 3.0 * moved_px);
    rig.look(view, 41 / kRate);
    EXPECT_LT(rig.front.jump_px(), 5.0) << "told twice";
}

TEST(FrontEdit, DoesNotDependOnThreads) {
    uint64_t hashes[2] = {};
    for (const unsigned threads : {1u, 3u}) {
        Rig rig(0.4, threads);
        for (int frame = 0; frame < 30; ++frame) {
            data::HeightBlock block = crater_at(rig.grid, {0.25 + 0.004 * frame, 0.6 + 0.01 * frame}, 120.0);
            rig.edit(block);
            rig.frame(flight(frame), frame / kRate, 300);
            uint64_t& hash = hashes[threads == 1 ? 0 : 1];
            hash = hash * 31 + rig.front.hash();
        }
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

/// What a small edit touches of a large mesh is the little that lies over it.
TEST(FrontEdit, CostFollowsTheRegion) {
    Rig rig(0.0, 2, 257);
    lod::View view = flight(0);
    view.width_px = 8000, view.height_px = 4500;  // far more triangles
    rig.frame(view, 0.0);
    const uint64_t records = rig.front.mesh().live_count(), evaluations = rig.front.evaluations();
    ASSERT_GT(records, 30'000u);
    data::HeightBlock block = crater_at(rig.grid, {0.294, 0.698}, 40.0);
    const terrain::FrontEditCounts counts = rig.edit(block);
    EXPECT_GT(counts.vertices, 10u);
    EXPECT_LT(counts.records, 20 * block.range.count());
    EXPECT_LT(counts.records, records / 20);
    EXPECT_EQ(rig.front.evaluations() - evaluations, counts.evaluations);
    EXPECT_LE(counts.evaluations, counts.records);
}

}  // namespace
