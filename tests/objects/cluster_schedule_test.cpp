// Trees against the schedule they were built from: presence, gamma and errors computed from the scene's own events, not from
// what the tree stores.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "data/scene_time.h"
#include "tests/objects/small_scenes.h"
#include "tests/objects/tree_surfaces.h"

namespace {

using objects::Cluster;
using objects::ClusterId;
using objects::ClusterTree;

/// Everything that rests, in source terms: instants at which anything changes, and each object's extent.
struct Source {
    data::TimedScene scene;
    std::vector<double> instants;  ///< rising, from 0 to the end
    std::vector<double> extent_m;  ///< [objects]

    explicit Source(data::TimedScene timed) : scene(std::move(timed)) {
        std::set<double> all = {0.0, scene.end_s};
        std::vector<data::TimeSpan> spans;
        for (const data::TimedObject& object : scene.objects) {
            data::visible_spans(scene, object, spans);
            for (const data::TimeSpan& span : spans)
                all.insert({span.begin_s, span.end_s});
            extent_m.push_back(extent_of(object));
        }
        instants.assign(all.begin(), all.end());
    }

    /// Share of some objects, weighed by extent, that is there at a time.
    double share(const std::vector<uint32_t>& objects, double time_s) const {
        double there = 0.0, total = 0.0;
        for (const uint32_t i : objects) {
            total += extent_m[i];
            there += data::is_visible(scene, scene.objects[i], time_s) ? extent_m[i] : 0.0;
        }
        return there / total;
    }

    /// (1/T) times the integral of the difference of two shares.
    double apart(const std::vector<uint32_t>& a, const std::vector<uint32_t>& b) const {
        double sum_s = 0.0;
        for (size_t i = 1; i < instants.size(); ++i)
            sum_s += (instants[i] - instants[i - 1]) *
                     std::abs(share(a, instants[i - 1]) - share(b, instants[i - 1]));
        return sum_s / scene.end_s;
    }

  private:
    double extent_of(const data::TimedObject& object) const {
        const data::ObjectPose pose = data::pose_at(scene, object, 0.0);
        glm::dvec3 low(1e30), high(-1e30);
        for (const glm::vec3& p : scene.meshes[object.mesh].positions) {
            const glm::dvec3 at = pose.rotation * glm::dvec3(p) + pose.position;
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
        return glm::length(high - low);
    }
};

std::vector<uint32_t> objects_below(const ClusterTree& tree, ClusterId id) {
    std::vector<ClusterId> leaves;
    objects_test::gather_leaves(tree, id, leaves);
    std::vector<uint32_t> objects;
    for (const ClusterId leaf : leaves)
        objects.push_back(tree.clusters[leaf].object);
    return objects;
}

ClusterTree build_exactly(const data::TimedScene& scene) {
    return objects::build_cluster_tree(scene, {.visibility_slack = 0.0, .threads = 2});
}

TEST(ClusterSchedule, PresenceIsWhatTheScheduleSays) {
    const Source source(objects_test::small_scene({.objects = 120, .seed = 21, .moving_share = 0.0}));
    const ClusterTree tree = build_exactly(source.scene);
    for (ClusterId id = 0; id < tree.clusters.size(); ++id) {
        const std::vector<uint32_t> below = objects_below(tree, id);
        for (size_t i = 1; i < source.instants.size(); ++i) {
            for (const double time_s :
                 {source.instants[i - 1], 0.5 * (source.instants[i - 1] + source.instants[i])})
                EXPECT_NEAR(objects::visibility_at(tree, tree.clusters[id].visibility, time_s),
                            source.share(below, time_s), 1e-6)
                    << "cluster " << id << " at " << time_s;
        }
    }
}

TEST(ClusterSchedule, GammaIsTheIntegralOverTheSchedule) {
    const Source source(objects_test::small_scene({.objects = 120, .seed = 22, .moving_share = 0.0}));
    const ClusterTree tree = build_exactly(source.scene);
    std::vector<double> gamma(tree.clusters.size(), 0.0);
    size_t apart = 0;
    for (ClusterId id = static_cast<ClusterId>(tree.clusters.size()); id-- > 0;) {
        const Cluster& c = tree.clusters[id];
        const std::vector<uint32_t> below = objects_below(tree, id);
        for (ClusterId child = c.first_child; child < c.first_child + c.child_count; ++child)
            gamma[id] = std::max(gamma[id], gamma[child] + source.apart(below, objects_below(tree, child)));
        EXPECT_NEAR(double(c.gamma), gamma[id], 1e-6) << "cluster " << id;
        apart += gamma[id] > 0.0;
    }
    EXPECT_GT(apart, 10u);
}

/// At every event and between any two: an object that is there is in one leaf, one that is not in none.
TEST(ClusterSchedule, OneLeafAtATime) {
    const Source source(objects_test::small_scene({.objects = 120, .seed = 23, .moving_share = 0.4}));
    const ClusterTree tree = build_exactly(source.scene);
    for (size_t i = 1; i < source.instants.size(); ++i) {
        for (const double time_s :
             {source.instants[i - 1], 0.5 * (source.instants[i - 1] + source.instants[i])}) {
            std::vector<int> leaves(source.scene.objects.size(), 0);
            for (const Cluster& c : tree.clusters) {
                if (c.child_count == 0 && objects::visibility_at(tree, c.visibility, time_s) == 1.0)
                    ++leaves[c.object];
            }
            for (size_t k = 0; k < leaves.size(); ++k)
                ASSERT_EQ(leaves[k], data::is_visible(source.scene, source.scene.objects[k], time_s))
                    << "object " << k << " at " << time_s;
        }
    }
}

TEST(ClusterSchedule, ErrorsNeverFallTowardsTheRoot) {
    for (const uint64_t seed : {24u, 25u, 26u}) {
        const ClusterTree tree =
            build_exactly(objects_test::small_scene({.objects = 200, .seed = seed, .moving_share = 0.2}));
        size_t rises = 0;
        for (ClusterId id = 1; id < tree.clusters.size(); ++id) {
            const Cluster &c = tree.clusters[id], &parent = tree.clusters[c.parent];
            EXPECT_GE(parent.error_m, c.error_m) << "cluster " << id;
            EXPECT_GE(parent.gamma, c.gamma) << "cluster " << id;
            EXPECT_GT(parent.level, c.level) << "cluster " << id;
            rises += parent.error_m > c.error_m;
        }
        EXPECT_GT(rises, 20u);
    }
}

}  // namespace
