// Cost follows change: counts of evaluations and operations, which are exact, on a flight, a turn and a teleport.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "lod/scheduler.h"
#include "terrain/roam_front.h"
#include "tests/terrain/test_relief.h"

namespace {

uint64_t allocations = 0;

}  // namespace

void* operator new(std::size_t size) {
    ++allocations;
    if (void* block = std::malloc(size)) return block;
    std::abort();
}
void operator delete(void* block) noexcept {
    std::free(block);
}
void operator delete(void* block, std::size_t) noexcept {
    std::free(block);
}

namespace {

constexpr double kTolerance = 0.5;

const data::HeightGrid& grid() {
    static const data::HeightGrid g = terrain_test::fractal_grid(1025, 1025, 10.0, 900.0, 1);
    return g;
}
const terrain::DiamondTable& table() {
    static const terrain::DiamondTable t = terrain::make_diamond_table(grid(), 2);
    return t;
}

/// 100 m/s at 60 Hz over the relief.
lod::View flight(int frame) {
    const double s = 100.0 / 60.0 * frame;
    return terrain_test::level_view({2000.0 + 0.6 * s, 2000.0 + 0.8 * s, double(grid().max_m) + 150.0},
                                    0.6435, -0.15);
}
lod::View turned(const lod::View& view) {
    lod::View back = view;
    back.eye_from_world = lod::eye_from_attitude(glm::dmat3(1.0), 0.6435 + 3.14159265, -0.15, 0.0);
    return back;
}

struct Rig {
    explicit Rig(bool pruning)
        : front(table(), {.tolerance_px = kTolerance, .reserve_triangles = 200'000, .is_pruning = pruning}) {}

    lod::ScheduleResult adapt(const lod::View& view) {
        lod::Front* fronts[] = {&front};
        front.begin_frame({&view, 1}, 0.0);
        return lod::schedule(fronts, {.tolerance_px = kTolerance}, deadline);
    }

    terrain::RoamFront front;
    lod::Deadline deadline = lod::operation_limit(UINT64_MAX);
};

TEST(Coherence, FlightLooksAtFewAndChangesFewer) {
    Rig rig(true);
    for (int frame = 0; frame < 30; ++frame)
        rig.adapt(flight(frame));
    const uint64_t evaluations = rig.front.evaluations();
    uint64_t operations = 0;
    for (int frame = 30; frame < 330; ++frame)
        operations += rig.adapt(flight(frame)).operations;
    const double records = rig.front.mesh().live_count();
    const double looked_at = double(rig.front.evaluations() - evaluations) / 300.0 / records;
    const double changed = double(operations) / 300.0 / double(rig.front.triangles());
    std::printf("%.0f triangles: %.2f %% of the records looked at, %.3f %% of the mesh changed a frame\n",
                double(rig.front.triangles()), 100.0 * looked_at, 100.0 * changed);
    EXPECT_LT(looked_at, 0.03);
    EXPECT_LT(changed, 0.01);
}

TEST(Coherence, StandingStillCostsNothing) {
    Rig rig(true);
    rig.adapt(flight(0));
    rig.adapt(flight(0));
    const uint64_t evaluations = rig.front.evaluations();
    EXPECT_EQ(rig.adapt(flight(0)).operations, 0u);
    EXPECT_LE(rig.front.evaluations() - evaluations, 2u);
}

TEST(Coherence, EnhMergeTakesATurnBackInFewOperations) {
    Rig whole(true), single(false);
    for (Rig* rig : {&whole, &single})
        rig->adapt(flight(0));
    const lod::View back = turned(flight(0));
    const auto before_whole = whole.front.operations(), before_single = single.front.operations();
    whole.adapt(back);
    single.adapt(back);
    const auto merges = [](const terrain::RoamFront& front, const lod::OperationCounts& before,
                           lod::OperationKind kind) { return front.operations()[kind] - before[kind]; };
    const uint64_t taken_single = merges(single.front, before_single, lod::OperationKind::kMerge);
    const uint64_t taken_whole = merges(whole.front, before_whole, lod::OperationKind::kMerge) +
                                 merges(whole.front, before_whole, lod::OperationKind::kEnhMerge);
    std::printf("merges one by one %llu, with enhMerge %llu\n", static_cast<unsigned long long>(taken_single),
                static_cast<unsigned long long>(taken_whole));
    EXPECT_LT(taken_whole * 5, taken_single);
    EXPECT_EQ(whole.front.validate(), "");
    EXPECT_LE(whole.front.error_px(), kTolerance);
}

/// A record is evaluated when it is made, and then not before its alarm: not when it becomes mergeable again.
TEST(Coherence, ARecordIsAskedOnce) {
    Rig rig(false);
    const lod::View view = flight(0);
    rig.front.begin_frame({&view, 1}, 0.0);
    const uint64_t at_first = rig.front.evaluations();
    uint32_t splits = 0, merges = 0;
    while (rig.front.refine_error_px() > kTolerance)
        splits += rig.front.refine().steps;
    const uint64_t records = rig.front.mesh().live_count();
    const uint64_t asked = rig.front.evaluations() - at_first;
    while (rig.front.mesh().triangles() > 2)
        merges += rig.front.coarsen(1e30).steps;
    EXPECT_GT(splits, 5'000u);
    EXPECT_EQ(merges, splits);
    EXPECT_EQ(asked, records - 1);
    EXPECT_EQ(rig.front.evaluations() - at_first, asked);
    EXPECT_EQ(rig.front.validate(), "");
}

/// Candidates that nobody has asked yet are asked before anyone takes the front for finished.
TEST(Coherence, NobodyIsForgottenWhereTheDeadlineCuts) {
    Rig rig(true);
    for (uint64_t limit = 0; limit < 400; ++limit) {
        rig.front.reset();
        const lod::View view = flight(0);
        rig.front.begin_frame({&view, 1}, 0.0);
        lod::Front* fronts[] = {&rig.front};
        lod::schedule(fronts, {.tolerance_px = kTolerance}, lod::operation_limit(limit));
        ASSERT_EQ(rig.front.validate(), "") << limit;
        const double told = rig.front.error_px();
        ASSERT_EQ(rig.front.validate(), "") << limit;
        ASSERT_LE(rig.front.refine_error_px(), told) << limit;
    }
    rig.adapt(flight(0));
    EXPECT_LE(rig.front.error_px(), kTolerance);
}

TEST(Coherence, AWarmFrameAllocatesNothing) {
    Rig rig(true);
    rig.adapt(flight(0));
    rig.front.place(rig.front.pool_need());
    lod::DrawList list;
    for (int frame = 1; frame < 20; ++frame) {
        rig.adapt(flight(frame));
        list.clear();
        rig.front.emit(flight(frame), list);
    }
    const uint64_t before = allocations;
    for (int frame = 20; frame < 60; ++frame) {
        rig.adapt(flight(frame));
        list.clear();
        rig.front.emit(flight(frame), list);
    }
    EXPECT_EQ(allocations - before, 0u);
}

TEST(Coherence, MemoryPerTriangle) {
    Rig rig(true);
    rig.adapt(flight(0));
    const double bytes = double(rig.front.memory_bytes()) / double(rig.front.triangles());
    std::printf("%.1f bytes a triangle\n", bytes);
    EXPECT_LE(bytes, 64.0);
}

}  // namespace
