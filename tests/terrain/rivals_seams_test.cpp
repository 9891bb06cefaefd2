// No gap shows between the pieces of a rival's mesh: those which claim so are conforming, wherever refinement was
// interrupted; where skirts hang, they reach below the neighbour's edge.
#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "tests/terrain/rival_rig.h"

namespace {

using terrain::GridPoint;
using terrain::Rival;
using terrain_test::DrawnTriangle;
using terrain_test::RivalRelief;

/// Flies about at random, stops refinement anywhere, and hands over everything that would be drawn.
template <typename Check>
void fly(const RivalRelief& relief, Rival kind, int cells, int frames, const Check& check) {
    const auto front = relief.front(kind, 1.0, cells);
    lod::Front* fronts[] = {front.get()};
    lod::Rng rng(static_cast<uint64_t>(relief.grid.width));
    for (int frame = 0; frame < frames; ++frame) {
        SCOPED_TRACE("frame " + std::to_string(frame));
        const lod::View views[] = {relief.random_view(rng), relief.whole()};
        front->begin_frame(views, 0.0);
        lod::Budget budget;
        budget.tolerance_px = std::exp2(rng.between(-2.0, 4.0));
        if (rng.unit() < 0.3) budget.max_triangles = front->triangles() + rng.below(6000);
        lod::schedule(fronts, budget, lod::operation_limit(rng.below(rng.unit() < 0.5 ? 50 : 5000)));
        lod::PoolRegion region = front->pool_need();
        region.index_capacity *= 2;  // two views
        front->place(region);
        terrain_test::PoolTwin pool;
        std::vector<DrawnTriangle> all;
        for (const lod::View& view : views) {
            lod::DrawList list;
            front->emit(view, list);
            pool.apply(list);
            all = terrain_test::drawn_triangles(pool, list, lod::Module::kTerrain);
            ASSERT_EQ(all.size(), front->emitted_triangles());
        }
        check(all);
        if (testing::Test::HasFatalFailure()) return;
    }
}

class ConformingRivals : public testing::TestWithParam<Rival> {};

TEST_P(ConformingRivals, HaveNoTJunction) {
    struct Case {
        int width, height, cells, frames;
    };
    for (const Case& c : {Case{129, 129, 16, 25},
                          {100, 131, 16, 25},
                          {130, 5, 8, 30},
                          {2, 2, 4, 3},
                          {3, 18, 4, 20},
                          {90, 75, 64, 20}}) {
        SCOPED_TRACE(std::to_string(c.width) + " x " + std::to_string(c.height));
        const RivalRelief relief(c.width, c.height, 10.0, 300.0, 2);
        fly(relief, GetParam(), c.cells, c.frames, [&](const std::vector<DrawnTriangle>& all) {
            ASSERT_EQ(terrain_test::conformity_fault(all), "");
            ASSERT_EQ(terrain_test::area_of(all), int64_t{2} * (c.width - 1) * (c.height - 1));
        });
        if (HasFatalFailure()) return;
    }
}

/// What an earlier frame has put into the pool stays; what has changed since is written again.
TEST_P(ConformingRivals, KeepThePoolUpToDate) {
    const RivalRelief relief(129, 129, 10.0, 300.0, 7);
    const auto front = relief.front(GetParam(), 1.0, 16);
    lod::Front* fronts[] = {front.get()};
    terrain_test::PoolTwin pool;
    lod::PoolRegion region;
    lod::Rng rng(8);
    for (int frame = 0; frame < 60; ++frame) {
        SCOPED_TRACE("frame " + std::to_string(frame));
        lod::View view = frame % 5 == 0 ? relief.whole() : relief.random_view(rng);
        front->begin_frame({&view, 1}, 0.0);
        lod::schedule(fronts, {.tolerance_px = std::exp2(rng.between(-3.0, 3.0))}, lod::operation_limit(300));
        const lod::PoolRegion need = front->pool_need();
        if (need.vertex_capacity > region.vertex_capacity || need.index_capacity > region.index_capacity) {
            region = {100, 2 * need.vertex_capacity, 300, 2 * need.index_capacity};
            front->place(region);
        }
        lod::DrawList list;
        front->emit(view, list);
        pool.apply(list);
        const auto all = terrain_test::drawn_triangles(pool, list, lod::Module::kTerrain);
        ASSERT_EQ(all.size(), front->emitted_triangles());
        ASSERT_EQ(terrain_test::conformity_fault(all), "");
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ConformingRivals,
                         testing::Values(Rival::kGeoMipmap, Rival::kVipmBlocks, Rival::kVdpm,
                                         Rival::kRoamMergeOnly),
                         [](const testing::TestParamInfo<Rival>& kind) {
                             return terrain_test::name_of(kind.param);
                         });

/// A sample on an edge from which a skirt hangs.
struct Hem {
    bool is_forward = false;  ///< the edge runs towards larger coordinates: which side the chunk is on
    double top_m = 0.0, bottom_m = 0.0;
};
using Line = std::tuple<bool, int, int>;  ///< along a row?, its number, position
using Hems = std::map<Line, std::vector<Hem>>;

/// Reads an upright strip's first triangle: both ends of the edge and what hangs below the first one.
bool read_skirt(const data::HeightGrid& grid, const DrawnTriangle& t, Hems& hems) {
    const auto is_top = [&](size_t i) {
        return std::abs(t.world[i].z - double(grid.at(t.samples[i].x, t.samples[i].y))) < 1e-9;
    };
    if (!is_top(0) || !is_top(1) || is_top(2) || t.samples[2] != t.samples[0]) return false;
    const GridPoint a = t.samples[0], b = t.samples[1];
    const bool is_row = a.y == b.y;
    const int from = is_row ? a.x : a.y, to = is_row ? b.x : b.y;
    const double depth_m = t.world[0].z - t.world[2].z;
    for (int i = std::min(from, to); i <= std::max(from, to); ++i) {
        const double top_m = t.world[0].z + (t.world[1].z - t.world[0].z) * (i - from) / (to - from);
        hems[{is_row, is_row ? a.y : a.x, i}].push_back({from < to, top_m, top_m - depth_m});
    }
    return true;
}

/// The widest gap, and by how much the skirt that covers it reaches further: negative means background shows.
struct Gap {
    double widest_m = 0.0, least_spare_m = 1e9;
    size_t places = 0;
};

Gap measure(const Hems& hems) {
    Gap gap;
    for (const auto& [line, at] : hems) {
        for (const Hem& one : at) {
            for (const Hem& other : at) {
                if (one.is_forward == other.is_forward || one.top_m <= other.top_m) continue;
                ++gap.places;
                gap.widest_m = std::max(gap.widest_m, one.top_m - other.top_m);
                gap.least_spare_m = std::min(gap.least_spare_m, other.top_m - one.bottom_m);
            }
        }
    }
    return gap;
}

TEST(ChunkedQuadtreeSkirts, ReachBelowEveryGap) {
    Gap worst;
    for (const auto& [width, height] : {std::pair{129, 129}, {200, 131}, {90, 150}}) {
        const RivalRelief relief(width, height, 10.0, 300.0, 5);
        fly(relief, Rival::kChunkedQuadtree, 8, 40, [&](const std::vector<DrawnTriangle>& all) {
            const auto ground = terrain_test::without_skirts(all);
            ASSERT_EQ(terrain_test::area_of(ground), int64_t{2} * (width - 1) * (height - 1));
            Hems hems;
            size_t edges = 0;
            for (const DrawnTriangle& t : all) {
                if (terrain_test::area_of(t) == 0) edges += read_skirt(relief.grid, t, hems) ? 1u : 0u;
            }
            ASSERT_EQ(2 * edges, all.size() - ground.size());
            const Gap gap = measure(hems);
            ASSERT_GE(gap.least_spare_m, 0.0) << "a skirt ends above the neighbour's edge";
            worst.widest_m = std::max(worst.widest_m, gap.widest_m);
            worst.least_spare_m = std::min(worst.least_spare_m, gap.least_spare_m);
            worst.places += gap.places;
        });
    }
    EXPECT_GT(worst.widest_m, 5.0) << "no gap to hide: the test saw nothing";
    EXPECT_LT(worst.least_spare_m, 0.5) << "skirts are deeper than they need to be";
    std::printf("%zu places with a gap, the widest %.1f m; the shortest skirt reaches %.3f m further\n",
                worst.places, worst.widest_m, worst.least_spare_m);
}

}  // namespace
