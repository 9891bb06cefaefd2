#include "objects/cluster_front.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lod/scheduler.h"
#include "objects/display.h"
#include "tests/objects/random_clusters.h"

namespace objects {
namespace {

constexpr double kEnd_s = 100.0;

lod::View random_view(lod::Rng& rng) {
    const auto point = [&](double reach) {
        const double x = rng.between(-reach, reach), y = rng.between(-reach, reach),
                     z = rng.between(1.0, 300.0);
        return glm::dvec3(x, y, z);
    };
    lod::View optics;
    optics.width_px = 640;
    optics.height_px = 360;
    optics.fov_y_rad = rng.between(0.5, 1.5);
    return lod::look_at(point(900.0), point(400.0), {0, 0, 1}, optics);
}

/// Times of any kind: within the schedule, exactly on an event, before, after.
double random_time_s(lod::Rng& rng, const ClusterTree& tree) {
    switch (rng.below(4)) {
        case 0:
            return tree.step_time_s[rng.below(tree.step_time_s.size())];
        case 1:
            return rng.between(-20.0, 120.0);
        default:
            return rng.between(0.0, kEnd_s);
    }
}

/// To the end, without hysteresis: only then is the cut a function of view and time.
void converge(ClusterFront& front, double tolerance_px) {
    std::vector<lod::Front*> fronts{&front};
    lod::Budget budget;
    budget.tolerance_px = tolerance_px;
    front.set_coarsen_ratio(1.0);
    ASSERT_TRUE(lod::schedule(fronts, budget, lod::operation_limit(1'000'000)).converged);
}

/// A scene that settles on changed ground: the same eye, the same time, another place.
TEST(ClusterFront, AfterAMoveItDrawsWhatOneBuiltThereDraws) {
    const RandomClusters scene(11, 1000, kEnd_s);
    ClusterFront moved(scene.tree(), {});
    lod::Rng rng(12);
    std::vector<ClusterId> drawn, expected, before;
    size_t changes = 0;
    for (int i = 0; i < 30; ++i) {
        const lod::View view = random_view(rng);
        moved.begin_frame({&view, 1}, 50.0);
        converge(moved, 2.0);
        moved.drawn(before);
        const ScenePlace place{glm::dmat3(1.0), {0.0, 0.0, rng.between(-300.0, 300.0)}};
        ClusterFront there(scene.tree(), place);
        moved.stand_at(place);
        for (ClusterFront* front : {&moved, &there}) {
            front->begin_frame({&view, 1}, 50.0);
            converge(*front, 2.0);
            EXPECT_EQ(front->validate(), "");
        }
        moved.drawn(drawn);
        there.drawn(expected);
        EXPECT_EQ(drawn, expected) << i;
        changes += drawn != before;
    }
    EXPECT_GT(changes, 10u);
}

TEST(ClusterFront, ConvergesToDisplayAtRandomEyesAndTimes) {
    const RandomClusters scene(1, 2000, kEnd_s);
    ClusterFront front(scene.tree(), {});
    front.set_hiding(Hiding::kNothing);  // DISPLAY knows of no hiding
    lod::Rng rng(2);
    std::vector<ClusterId> expected, drawn;
    uint64_t drawn_count = 0;
    lod::View view = random_view(rng);
    double time_s = 0.0;
    for (int i = 0; i < 1000; ++i) {
        SCOPED_TRACE(i);
        const double tolerance_px = std::exp(rng.between(-1.0, 4.0));
        // Sometimes the eye stays and only time goes on, sometimes the other way round.
        if (rng.below(3) != 0) view = random_view(rng);
        if (rng.below(3) != 0) time_s = random_time_s(rng, scene.tree());
        front.begin_frame({&view, 1}, time_s);
        converge(front, tolerance_px);
        const SceneView sight(view, {});
        const double error_px =
            display(scene.tree(), {&sight, 1}, std::clamp(time_s, 0.0, kEnd_s), tolerance_px, expected);
        std::sort(expected.begin(), expected.end());
        front.drawn(drawn);
        ASSERT_EQ(drawn, expected);
        EXPECT_EQ(front.error_px(), error_px);
        EXPECT_LE(front.error_px(), tolerance_px);
        ASSERT_EQ(front.validate(), "");
        drawn_count += drawn.size();
    }
    EXPECT_GT(drawn_count, 50'000u);  // the comparison was not one of empty pictures
}

TEST(ClusterFront, IsValidAfterEveryOperation) {
    const RandomClusters scene(3, 400, kEnd_s);
    ClusterFront front(scene.tree(), {});
    lod::Rng rng(4);
    for (int frame = 0; frame < 40; ++frame) {
        const lod::View view = random_view(rng);
        front.begin_frame({&view, 1}, rng.between(0.0, kEnd_s));
        for (int i = 0; i < 50; ++i) {
            const uint64_t before = front.triangles();
            const lod::Step step = rng.below(3) == 0 ? front.coarsen(rng.between(0.0, 20.0)) : front.refine();
            ASSERT_EQ(front.triangles() - before, static_cast<uint64_t>(step.triangle_delta));
            ASSERT_EQ(front.validate(), "");
        }
    }
}

/// A budget of nothing takes back what it can, but nothing without something that stands for it.
TEST(ClusterFront, WithoutABudgetIsCoarserNeverMissing) {
    lod::Rng rng(8);
    int seen_count = 0, bare_count = 0;
    for (uint64_t seed = 100; seed < 130; ++seed) {
        SCOPED_TRACE(seed);
        const RandomClusters scene(seed, 200, kEnd_s);
        ClusterFront front(scene.tree(), {});
        std::vector<lod::Front*> fronts{&front};
        bare_count += scene.tree().clusters[0].geometry == kNoGeometry ? 1 : 0;
        for (int i = 0; i < 10; ++i) {
            const lod::View view = random_view(rng);
            front.begin_frame({&view, 1}, rng.between(0.0, kEnd_s));
            converge(front, 4.0);
            const uint64_t most = front.triangles();
            lod::schedule(fronts, {.tolerance_px = 4.0, .max_triangles = 1}, lod::operation_limit(100'000));
            EXPECT_LE(front.triangles(), most);
            ASSERT_EQ(front.validate(), "");  // looks for clusters in view with nothing to draw
            seen_count += most > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(seen_count, 100);
    EXPECT_GT(bare_count, 1);
}

TEST(ClusterFront, ForgetsHowItCameToATime) {
    const RandomClusters scene(5, 1000, kEnd_s);
    lod::Rng rng(6);
    const lod::View view = random_view(rng);
    const auto hash_at_end = [&](std::initializer_list<double> times_s) {
        ClusterFront front(scene.tree(), {});
        for (double time_s : times_s) {
            front.begin_frame({&view, 1}, time_s);
            converge(front, 2.0);
        }
        return std::pair(front.hash(), front.triangles());
    };
    const auto straight = hash_at_end({37.0});
    EXPECT_EQ(hash_at_end({0.0, 12.0, 36.0, 37.0}), straight);            // played
    EXPECT_EQ(hash_at_end({100.0, 60.0, 37.5, 37.0}), straight);          // reversed
    EXPECT_EQ(hash_at_end({99.0, 1.0, -5.0, 1e9, NAN, 37.0}), straight);  // sought
}

TEST(ClusterFront, LooksUpOnlyWhatHasAnEventInBetween) {
    const RandomClusters scene(7, 3000, kEnd_s);
    ClusterFront front(scene.tree(), {});
    lod::Rng rng(8);
    const lod::View view = random_view(rng);
    front.begin_frame({&view, 1}, 50.0);
    converge(front, 0.5);
    front.begin_frame({&view, 1},
                      50.0);  // after so many changes all is looked at once more: what may be hidden now?
    const auto events_between = [&](double from_s, double to_s) {
        uint64_t count = 0;
        for (ClusterId id = 0; id < scene.tree().clusters.size(); ++id) {
            const uint32_t visibility = scene.tree().clusters[id].visibility;
            count += step_at(scene.tree(), visibility, from_s) != step_at(scene.tree(), visibility, to_s);
        }
        return count;
    };
    for (double to_s : {50.0, 50.05, 50.0, 49.9, 50.0}) {
        const uint64_t lookups = front.presence_lookups(), evaluations = front.evaluations();
        front.begin_frame({&view, 1}, to_s);
        EXPECT_LE(front.presence_lookups() - lookups, events_between(49.9, 50.05));
        EXPECT_LE(front.evaluations() - evaluations, 1000u);  // those that moved or had an event
    }
    const uint64_t evaluations = front.evaluations();
    front.begin_frame({&view, 1}, 50.0);
    EXPECT_EQ(front.evaluations(), evaluations);
}

TEST(ClusterFront, DrawsWhatTheListSays) {
    const RandomClusters scene(9, 500, kEnd_s);
    ClusterFront front(scene.tree(), {});
    const lod::PoolRegion need = front.pool_need();
    front.place({7, need.vertex_capacity, 9, need.index_capacity});
    lod::Rng rng(10);
    std::vector<ClusterId> drawn;
    for (int i = 0; i < 20; ++i) {
        const lod::View view = random_view(rng);
        front.begin_frame({&view, 1}, rng.between(0.0, kEnd_s));
        converge(front, 4.0);
        lod::DrawList list;
        front.emit(view, list);
        EXPECT_EQ(list.vertex_writes.size(), i == 0 ? 1u : 0u);  // geometry is written once
        front.drawn(drawn);
        uint64_t expected = 0, listed = 0;
        for (ClusterId id : drawn)
            expected += scene.tree().geometries[scene.tree().clusters[id].geometry].index_count;
        for (const lod::DrawItem& item : list.items) {
            listed += item.index_count;
            ASSERT_LT(item.instance, list.instances.size());
            ASSERT_GE(item.base_vertex, 7);
            ASSERT_GE(item.first_index, 9u);
        }
        EXPECT_EQ(listed, expected);
        EXPECT_EQ(front.emitted_triangles(), expected / 3);
    }
}

}  // namespace
}  // namespace objects
