#include "data/scenes/construction_site.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "data/object_plan.h"
#include "data/scene_time.h"

namespace data {
namespace {

const TimedScene& site() {
    static const TimedScene scene = generate_construction_site(0);
    return scene;
}

struct Seen {
    uint64_t objects = 0, triangles = 0;
};
Seen seen_at(const TimedScene& scene, double time_s) {
    Seen seen;
    for (const TimedObject& object : scene.objects) {
        if (!is_visible(scene, object, time_s)) continue;
        ++seen.objects;
        seen.triangles += scene.meshes[object.mesh].triangles.size();
    }
    return seen;
}

TEST(ConstructionSite, HasThePapersCountsForEverySeed) {
    for (const uint64_t seed : {0u, 1u, 2u, 12345u}) {
        const TimedScene scene = generate_construction_site(seed);
        const auto sound = check_timed_scene(scene);
        ASSERT_TRUE(sound) << sound.message();
        ASSERT_EQ(scene.objects.size(), 56157u);
        // Classes told apart here by what is seen, not by the function under test.
        ClassCounts counts;
        for (const TimedObject& object : scene.objects) {
            bool moves = false, changes = false;
            const auto keys = keys_of(scene, object);
            for (const KeyFrame& key : keys)
                moves = moves || key.position != keys[0].position || key.rotation != keys[0].rotation;
            for (const VisibilityStep& step : steps_of(scene, object)) {
                changes = changes || is_visible(scene, object, step.time_s) !=
                                         is_visible(scene, object, std::nextafter(step.time_s, -1.0));
            }
            const size_t index = moves ? 2 : changes ? 1 : 0;
            ++counts.objects[index];
            counts.triangles[index] += scene.meshes[object.mesh].triangles.size();
        }
        EXPECT_EQ(counts.objects, (std::array<uint64_t, 3>{498, 40010, 15649}));
        EXPECT_EQ(counts.triangles, (std::array<uint64_t, 3>{66784, 2879506, 1313767}));
        const ClassCounts told = count_classes(scene);
        EXPECT_EQ(told.objects, counts.objects);
        EXPECT_EQ(told.triangles, counts.triangles);
    }
}

TEST(ConstructionSite, SeedsDifferAndEqualSeedsDoNot) {
    const TimedScene again = generate_construction_site(0), other = generate_construction_site(1);
    const auto equal = [](const VisibilityStep& a, const VisibilityStep& b) {
        return a.time_s == b.time_s && a.is_visible == b.is_visible;
    };
    EXPECT_TRUE(
        std::equal(again.steps.begin(), again.steps.end(), site().steps.begin(), site().steps.end(), equal));
    EXPECT_FALSE(
        std::equal(other.steps.begin(), other.steps.end(), site().steps.begin(), site().steps.end(), equal));
}

TEST(ConstructionSite, SharesGeometry) {
    EXPECT_LT(site().meshes.size(), 120u);
    uint64_t stored = 0;
    for (const TimedMesh& mesh : site().meshes)
        stored += mesh.triangles.size();
    EXPECT_LT(stored, 15000u) << "4.26 million are drawn";
}

TEST(ConstructionSite, GrowsFromBeginningToEnd) {
    const double end_s = site().end_s;
    const Seen start = seen_at(site(), 0.0), third = seen_at(site(), end_s / 3.0),
               two_thirds = seen_at(site(), 2.0 * end_s / 3.0), end = seen_at(site(), end_s);
    EXPECT_LT(start.triangles, 0.45 * static_cast<double>(end.triangles));
    EXPECT_LT(start.triangles, third.triangles);
    EXPECT_LT(third.triangles, two_thirds.triangles);
    EXPECT_LT(two_thirds.triangles, end.triangles);
    EXPECT_GT(end.triangles, 1700000u);
}

/// Nothing is built on what is not there: at any time the highest slab is at most a storey above the highest column.
TEST(ConstructionSite, IsBuiltFromBelow) {
    for (double time_s = 500.0; time_s < 2600.0; time_s += 50.0) {
        double slab_m = -100.0, column_m = -100.0;
        for (const TimedObject& object : site().objects) {
            const double height_m = site().keys[object.keys.begin].position.z;
            if (!is_visible(site(), object, time_s)) continue;
            if (object.id.starts_with("slab-")) slab_m = std::max(slab_m, height_m);
            if (object.id.starts_with("column-")) column_m = std::max(column_m, height_m);
        }
        EXPECT_LE(slab_m, column_m + 4.001) << "at " << time_s;
        EXPECT_GE(slab_m, column_m - 4.001) << "at " << time_s;
    }
}

/// What a crane lifts hangs on its hook: a rack's parts stay within a few metres of one of the hooks.
TEST(ConstructionSite, LoadsHangOnHooks) {
    std::vector<const TimedObject*> hooks, loads;
    for (const TimedObject& object : site().objects) {
        if (object.id.starts_with("hook-")) hooks.push_back(&object);
        if (object.id.starts_with("panel-") || object.id.starts_with("bundle-")) loads.push_back(&object);
    }
    ASSERT_EQ(hooks.size(), 4u);
    ASSERT_GT(loads.size(), 2000u);
    for (size_t i = 0; i < loads.size(); i += 97) {
        const auto keys = keys_of(site(), *loads[i]);
        for (double share = 0.0; share <= 1.0; share += 0.05) {
            const double time_s = glm::mix(keys.front().time_s, keys.back().time_s, share);
            const glm::dvec3 at = pose_at(site(), *loads[i], time_s).position;
            double nearest_m = 1e9;
            for (const TimedObject* hook : hooks)
                nearest_m = std::min(nearest_m, glm::distance(at, pose_at(site(), *hook, time_s).position));
            EXPECT_LT(nearest_m, 6.0) << loads[i]->id << " at " << time_s;
        }
    }
}

/// Erection is coherent: what appears next in a storey is near what appeared last.
TEST(ConstructionSite, ErectsNeighboursOneAfterTheOther) {
    struct Event {
        double time_s;
        glm::dvec3 position;
    };
    std::vector<Event> slabs;
    for (const TimedObject& object : site().objects) {
        const glm::dvec3 at = site().keys[object.keys.begin].position;
        if (object.id.starts_with("slab-") && at.z == 80.0)
            slabs.push_back({site().steps[object.steps.begin].time_s, at});
    }
    ASSERT_EQ(slabs.size(), 32u);
    std::sort(slabs.begin(), slabs.end(), [](const Event& a, const Event& b) { return a.time_s < b.time_s; });
    double way_m = 0.0;
    for (size_t i = 1; i < slabs.size(); ++i)
        way_m += glm::distance(slabs[i].position, slabs[i - 1].position) / 31.0;
    EXPECT_LT(way_m, 14.0) << "at random it would be about 22 m";
}

}  // namespace
}  // namespace data
