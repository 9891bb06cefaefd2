#include "data/scenes/scene_family.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "data/object_plan.h"
#include "data/scene_time.h"

namespace data {
namespace {

constexpr SceneFamily kFamilies[] = {SceneFamily::kHighRise, SceneFamily::kGroup, SceneFamily::kScattered};

glm::dvec3 place_of(const TimedScene& scene, const TimedObject& object) {
    return scene.keys[object.keys.end - 1].position;
}

TEST(SceneFamily, HasExactlyTheObjectsAndTriangles) {
    for (const SceneFamily family : kFamilies) {
        for (const uint32_t objects : {1u, 7u, 1000u, 4321u}) {
            for (const uint32_t triangles : {12u, 13u, 60u, 71u}) {
                const TimedScene scene = generate_family(
                    {.family = family, .objects = objects, .triangles = triangles, .sparsity = 0.3});
                const auto sound = check_timed_scene(scene);
                ASSERT_TRUE(sound) << sound.message();
                ASSERT_EQ(scene.objects.size(), objects);
                ASSERT_LE(scene.meshes.size(), 8u);
                std::set<std::tuple<double, double, double>> places;
                for (const TimedObject& object : scene.objects) {
                    ASSERT_EQ(scene.meshes[object.mesh].triangles.size(), triangles);
                    const glm::dvec3 at = place_of(scene, object);
                    ASSERT_TRUE(places.insert({at.x, at.y, at.z}).second) << "two in one cell";
                }
            }
        }
    }
}

TEST(SceneFamily, IntensityIsTheMeanNumberOfEvents) {
    for (const double intensity : {0.0, 0.5, 1.0, 2.25, 5.0}) {
        const TimedScene scene = generate_family({.objects = 20000, .events_per_object = intensity});
        EXPECT_NEAR(static_cast<double>(scene.steps.size()) / 20000.0, intensity, 0.02);
        for (const VisibilityStep& step : scene.steps)
            ASSERT_TRUE(step.time_s > 0.0 && step.time_s < scene.end_s);
        const ClassCounts counts = count_classes(scene);
        EXPECT_TRUE(intensity != 0.0 || counts.objects[0] == 20000u);
        EXPECT_TRUE(intensity < 1.0 || counts.objects[1] == 20000u);
    }
}

TEST(SceneFamily, SharesOfMoversAndOfEmptyCells) {
    const TimedScene moving = generate_family({.objects = 20000, .moving_share = 0.25});
    EXPECT_NEAR(static_cast<double>(count_classes(moving).objects[2]), 5000.0, 250.0);
    const auto density = [](double sparsity) {
        const TimedScene scene = generate_family({.objects = 16384, .sparsity = sparsity});
        glm::dvec3 high(0.0);
        for (const TimedObject& object : scene.objects)
            high = glm::max(high, place_of(scene, object) / 4.0 + 1.0);
        return 16384.0 / (high.x * high.y * high.z);
    };
    EXPECT_EQ(density(0.0), 1.0) << "16 x 16 x 64 cells, all full";
    EXPECT_NEAR(density(0.6), 0.4, 0.05);
}

/// Mean distance between objects that appear one after the other, in cells.
double way_between(const TimedScene& scene) {
    std::vector<std::pair<double, glm::dvec3>> events;
    for (const TimedObject& object : scene.objects)
        events.emplace_back(scene.steps[object.steps.begin].time_s, place_of(scene, object) / 4.0);
    std::sort(events.begin(), events.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    double way = 0.0;
    for (size_t i = 1; i < events.size(); ++i)
        way += glm::distance(events[i].second, events[i - 1].second);
    return way / static_cast<double>(events.size() - 1);
}

TEST(SceneFamily, CoherenceIsNearnessInSpaceAndTime) {
    double before = 0.0;
    for (const double coherence : {1.0, 0.99, 0.9, 0.5, 0.0}) {
        const double way = way_between(generate_family({.objects = 16384, .coherence = coherence}));
        EXPECT_GT(way, before) << coherence;
        before = way;
    }
    EXPECT_LT(way_between(generate_family({.objects = 16384})), 1.01) << "from neighbour to neighbour";
    EXPECT_GT(way_between(generate_family({.family = SceneFamily::kScattered, .objects = 16384})), 12.0);
}

TEST(SceneFamily, AMillionObjects) {
    const TimedScene scene =
        generate_family({.family = SceneFamily::kGroup, .objects = 1000000, .events_per_object = 1.5});
    EXPECT_EQ(scene.objects.size(), 1000000u);
    EXPECT_LT(scene.meshes.size(), 9u);
    EXPECT_NEAR(static_cast<double>(scene.steps.size()), 1.5e6, 2e3);
}

TEST(SceneFamily, IsTheSameForEqualSeeds) {
    const TimedScene a = generate_family({.seed = 3, .objects = 5000}),
                     b = generate_family({.seed = 3, .objects = 5000}),
                     c = generate_family({.seed = 4, .objects = 5000});
    size_t equal = 0;
    for (size_t i = 0; i < a.objects.size(); ++i) {
        ASSERT_EQ(a.steps[i].time_s, b.steps[i].time_s);
        ASSERT_EQ(a.objects[i].mesh, b.objects[i].mesh);
        equal += a.objects[i].mesh == c.objects[i].mesh ? 1u : 0u;
    }
    EXPECT_LT(equal, 1000u);
}

}  // namespace
}  // namespace data
