// The rivals as fronts: valid after every operation, the same on every run, the source itself at tolerance 0,
// fewer triangles for a larger tolerance, and nothing to do while nothing moves.
#include "terrain/rivals/rivals.h"

#include <gtest/gtest.h>

#include "tests/terrain/rival_rig.h"

namespace {

using terrain::Rival;
using terrain_test::RivalRelief;

class Rivals : public testing::TestWithParam<Rival> {};

TEST_P(Rivals, ValidAfterEveryOperation) {
    const RivalRelief relief(150, 97, 8.0, 250.0, 1);
    const auto front = relief.front(GetParam(), 0.5, 8);
    ASSERT_EQ(front->validate(), "");
    lod::Front* fronts[] = {front.get()};
    lod::Rng rng(3);
    uint64_t operations = 0;
    for (int frame = 0; frame < 12; ++frame) {
        const lod::View view = relief.random_view(rng);
        front->begin_frame({&view, 1}, 0.0);
        for (int i = 0; i < 150; ++i) {
            const auto done = lod::schedule(fronts, {.tolerance_px = 0.5}, lod::operation_limit(1));
            ASSERT_EQ(front->validate(), "") << "frame " << frame << ", operation " << i;
            if (done.converged) break;
            ++operations;
        }
    }
    EXPECT_GT(operations, 300u);
}

TEST_P(Rivals, StepsTellWhatChanged) {
    const RivalRelief relief(150, 97, 8.0, 250.0, 2);
    const auto front = relief.front(GetParam(), 0.5, 16);
    const lod::View view = relief.whole();
    front->begin_frame({&view, 1}, 0.0);
    auto said = static_cast<int64_t>(front->triangles());
    uint64_t hash = front->hash();
    for (int i = 0; i < 200 && front->refine_error_px() > 0.0; ++i) {
        const lod::Step step = front->refine();
        ASSERT_GT(step.steps, 0u);
        said += step.triangle_delta;
        ASSERT_EQ(said, static_cast<int64_t>(front->triangles()));
        ASSERT_NE(front->hash(), hash);
        hash = front->hash();
    }
    EXPECT_EQ(front->coarsen(-1.0).steps, 0u);
    for (int i = 0; i < 100; ++i) {
        const lod::Step step = front->coarsen(1e9);
        if (step.steps == 0) break;
        said += step.triangle_delta;
        ASSERT_EQ(said, static_cast<int64_t>(front->triangles()));
    }
    EXPECT_EQ(front->validate(), "");
}

TEST_P(Rivals, ToleranceZeroIsTheSourceItself) {
    for (const auto& [width, height] : {std::pair{97, 65}, {100, 73}, {5, 40}}) {
        const RivalRelief relief(width, height, 10.0, 100.0, 3);
        const auto front = relief.front(GetParam(), 0.0, 16);
        const lod::View view = relief.whole();
        ASSERT_TRUE(terrain_test::converge(*front, view, 0.0));
        EXPECT_EQ(front->error_px(), 0.0);
        terrain_test::PoolTwin pool;
        const auto ground = terrain_test::without_skirts(terrain_test::emit_triangles(*front, view, pool));
        EXPECT_EQ(ground.size(), 2u * static_cast<size_t>(width - 1) * static_cast<size_t>(height - 1));
        EXPECT_EQ(terrain_test::area_of(ground), int64_t{2} * (width - 1) * (height - 1));
        EXPECT_EQ(front->validate(), "");
    }
}

TEST_P(Rivals, FewerTrianglesForALargerTolerance) {
    const RivalRelief relief(129, 129, 8.0, 300.0, 4);
    lod::Rng rng(5);
    for (int i = 0; i < 3; ++i) {
        const auto front = relief.front(GetParam(), 1.0, 16);
        const lod::View view = relief.random_view(rng);
        uint64_t last = UINT64_MAX, first = 0;
        for (const double tolerance_px : {0.5, 1.0, 2.0, 4.0, 8.0}) {
            ASSERT_TRUE(terrain_test::converge(*front, view, tolerance_px));
            EXPECT_LE(front->error_px(), tolerance_px);
            EXPECT_LE(front->triangles(), last);
            last = front->triangles();
            if (first == 0) first = last;
        }
        EXPECT_LT(last, first * 3 / 4);
    }
}

/// Refining from the coarsest mesh and coming from elsewhere need not agree, but two runs of the same flight must.
TEST_P(Rivals, SameFlightSameHashes) {
    const RivalRelief relief(150, 200, 8.0, 300.0, 6);
    std::vector<uint64_t> hashes[2];
    for (unsigned run = 0; run < 2; ++run) {
        const auto front = relief.front(GetParam(), 1.0, 32, run + 1);
        lod::Front* fronts[] = {front.get()};
        lod::Rng rng(7);
        for (int frame = 0; frame < 20; ++frame) {
            const lod::View view = relief.random_view(rng);
            front->begin_frame({&view, 1}, frame / 60.0);
            lod::schedule(fronts, {.tolerance_px = 1.0, .max_triangles = 20000},
                          lod::operation_limit(rng.below(300)));
            hashes[run].push_back(front->hash());
        }
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_NE(hashes[0].front(), hashes[0].back());
}

TEST_P(Rivals, StandingStillCostsNothing) {
    const RivalRelief relief(129, 129, 8.0, 300.0, 8);
    const auto front = relief.front(GetParam(), 1.0, 32);
    lod::Rng rng(9);
    const lod::View view = relief.random_view(rng);
    ASSERT_TRUE(terrain_test::converge(*front, view, 1.0));
    terrain_test::PoolTwin pool;
    terrain_test::emit_triangles(*front, view, pool);
    const uint64_t hash = front->hash();
    lod::Front* fronts[] = {front.get()};
    for (int frame = 0; frame < 3; ++frame) {
        front->begin_frame({&view, 1}, 0.0);
        EXPECT_EQ(lod::schedule(fronts, {.tolerance_px = 1.0}, lod::operation_limit(1000)).operations, 0u);
        EXPECT_EQ(front->hash(), hash);
        lod::DrawList list;
        front->emit(view, list);
        EXPECT_TRUE(list.vertex_writes.empty());
    }
    EXPECT_GT(front->memory_bytes(), 0u);
}

TEST_P(Rivals, TheTriangleLimitHolds) {
    const RivalRelief relief(129, 129, 8.0, 300.0, 10);
    const auto front = relief.front(GetParam(), 0.5, 16);
    lod::Front* fronts[] = {front.get()};
    lod::Rng rng(11);
    const uint64_t least = front->triangles();
    for (int frame = 0; frame < 20; ++frame) {
        const lod::View view = relief.random_view(rng);
        const uint64_t limit = least + 1000 + rng.below(5000);
        front->begin_frame({&view, 1}, 0.0);
        EXPECT_TRUE(lod::schedule(fronts, {.tolerance_px = 0.25, .max_triangles = limit},
                                  lod::operation_limit(1'000'000))
                        .converged);
        EXPECT_LE(front->triangles(), limit);
        EXPECT_EQ(front->validate(), "");
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Rivals,
                         testing::Values(Rival::kChunkedQuadtree, Rival::kGeoMipmap, Rival::kVipmBlocks,
                                         Rival::kVdpm, Rival::kRoamMergeOnly),
                         [](const testing::TestParamInfo<Rival>& kind) {
                             return terrain_test::name_of(kind.param);
                         });

}  // namespace
