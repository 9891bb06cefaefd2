// The same operations give the same mesh: on one thread or two, in one go or one by one, now or next year; and the
// mesh is whole after every single one of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <set>

#include "lod/base/hash.h"
#include "lod/scheduler.h"
#include "terrain/roam_front.h"
#include "tests/terrain/drawn_mesh.h"

namespace {

const data::HeightGrid& jacksboro() {
    static const auto grid =
        data::read_height_grid({std::string(HARRIER_SOURCE_DIR) + "/data/samples/jacksboro.tif"}, {});
    return *grid;
}

/// From a place of the raster, over its highest summit.
lod::View view_at(double col_share, double row_share, double heading_rad, double pitch_rad) {
    const data::HeightGrid& grid = jacksboro();
    lod::View view;
    view.eye_world = grid.frame.world_from_grid(col_share * grid.width, row_share * grid.height, 1150.0);
    view.eye_from_world = lod::eye_from_attitude(grid.frame.world().world_from_enu(view.eye_world),
                                                 heading_rad, pitch_rad, 0.0);
    view.width_px = 1280;
    view.height_px = 720;
    return view;
}

/// A curving flight, with a jump in the middle.
lod::View flight_view(int frame) {
    const double t = frame / 200.0;
    const double jump = frame < 100 ? 0.0 : 0.3;
    return view_at(0.2 + 0.3 * t + jump, 0.3 + 0.4 * t - jump, 1.0 + 4.0 * t, -0.15 - 0.1 * t);
}

/// What is drawn, in its order.
uint64_t hash_of(const std::vector<terrain_test::DrawnTriangle>& triangles) {
    uint64_t hash = 0;
    for (const terrain_test::DrawnTriangle& triangle : triangles) {
        for (size_t i = 0; i < 3; ++i) {
            hash = lod::hash_combine(hash, static_cast<uint64_t>(triangle.samples[i].x));
            hash = lod::hash_combine(hash, static_cast<uint64_t>(triangle.samples[i].y));
            for (int axis = 0; axis < 3; ++axis)
                hash = lod::hash_combine(hash, std::bit_cast<uint64_t>(triangle.world[i][axis]));
        }
    }
    return hash;
}

struct Flown {
    std::vector<uint64_t> front_hashes, drawn_hashes;
};

Flown fly(unsigned threads, uint64_t operations) {
    terrain::RoamFront front(terrain::make_diamond_table(jacksboro(), threads),
                             {.tolerance_px = 1.0, .threads = threads});
    lod::Front* fronts[] = {&front};
    Flown flown;
    for (int frame = 0; frame < 200; ++frame) {
        const lod::View view = flight_view(frame);
        front.begin_frame({&view, 1}, frame / 60.0);
        lod::schedule(fronts, {.tolerance_px = 1.0, .max_triangles = 20000},
                      lod::operation_limit(operations));
        terrain_test::PoolTwin pool;
        flown.front_hashes.push_back(front.hash());
        flown.drawn_hashes.push_back(hash_of(terrain_test::emit_triangles(front, view, pool)));
    }
    return flown;
}

TEST(TerrainReplay, SameOperationsSameMeshOnOneAndTwoThreads) {
    const Flown one = fly(1, 400), two = fly(2, 400), again = fly(2, 400);
    EXPECT_EQ(one.front_hashes, two.front_hashes);
    EXPECT_EQ(one.drawn_hashes, two.drawn_hashes);
    EXPECT_EQ(two.front_hashes, again.front_hashes);
    EXPECT_EQ(two.drawn_hashes, again.drawn_hashes);
    const std::set<uint64_t> fronts(one.front_hashes.begin(), one.front_hashes.end());
    EXPECT_GT(fronts.size(), 190u) << "the flight should change the mesh in nearly every frame";
    EXPECT_NE(fly(1, 399).front_hashes, one.front_hashes);
}

TEST(TerrainReplay, TableIsTheSameOnAnyNumberOfThreads) {
    const terrain::DiamondTable one = terrain::make_diamond_table(jacksboro(), 1);
    for (const unsigned threads : {2u, 3u, 8u}) {
        const terrain::DiamondTable many = terrain::make_diamond_table(jacksboro(), threads);
        ASSERT_EQ(one.slots.size(), many.slots.size());
        EXPECT_EQ(0, std::memcmp(one.slots.data(), many.slots.data(),
                                 one.slots.size() * sizeof(terrain::DiamondSource)));
    }
}

/// Refines, coarsens to a loose tolerance, refines again, turns round: every kind of operation occurs. A leg ends
/// after some operations, or when nothing is left to do.
class Journey {
  public:
    Journey() : front(terrain::make_diamond_table(jacksboro(), 2), {.tolerance_px = 1.0}) { begin_leg(); }

    void go(uint64_t operations) {
        lod::Front* fronts[] = {&front};
        while (operations > 0 && leg_ < std::size(kLegs)) {
            const auto done = lod::schedule(fronts, {.tolerance_px = kLegs[leg_].tolerance_px},
                                            lod::operation_limit(std::min(operations, left_)));
            operations -= done.operations;
            left_ -= done.operations;
            if (!done.converged && left_ > 0) continue;
            ++leg_;
            if (leg_ < std::size(kLegs)) begin_leg();
        }
    }
    bool is_over() const { return leg_ == std::size(kLegs); }

    terrain::RoamFront front;

  private:
    struct Leg {
        uint64_t operations;
        double heading_rad, tolerance_px;
    };
    static constexpr Leg kLegs[] = {
        {1500, 0.0, 1.0}, {300, 0.0, 24.0}, {1500, 0.4, 1.0}, {400, 0.4, 32.0}, {9000, 3.5, 0.7}};

    void begin_leg() {
        left_ = kLegs[leg_].operations;
        const lod::View view = view_at(0.5, 0.5, kLegs[leg_].heading_rad, -0.1);
        front.begin_frame({&view, 1}, 0.0);
    }
    size_t leg_ = 0;
    uint64_t left_ = 0;
};

TEST(TerrainReplay, WholeAfterEveryOperationUpToFiveThousand) {
    Journey journey;
    std::vector<uint64_t> hashes{journey.front.hash()};
    ASSERT_EQ(journey.front.validate(), "");
    for (int operation = 1; operation <= 5000; ++operation) {
        journey.go(1);
        ASSERT_FALSE(journey.is_over()) << "operation " << operation;
        ASSERT_EQ(journey.front.validate(), "") << "after operation " << operation;
        hashes.push_back(journey.front.hash());
    }
    const lod::OperationCounts counts = journey.front.operations();
    for (const auto kind : {lod::OperationKind::kSplit, lod::OperationKind::kForcedSplit,
                            lod::OperationKind::kMerge, lod::OperationKind::kEnhMerge}) {
        EXPECT_GT(counts[kind], 0u) << "kind " << static_cast<int>(kind);
    }
    for (const uint64_t stop : {0u, 1u, 2u, 3u, 7u, 50u, 333u, 1024u, 2499u, 2500u, 2501u, 3456u, 5000u}) {
        Journey again;
        again.go(stop);
        EXPECT_EQ(again.front.validate(), "") << "interrupted after " << stop;
        EXPECT_EQ(again.front.hash(), hashes[stop]) << "interrupted after " << stop;
    }
}

}  // namespace
