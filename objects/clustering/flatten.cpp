#include "objects/clustering/flatten.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_map>

#include "lod/base/hash.h"
#include "objects/clustering/grouping.h"
#include "objects/clustering/scene_frame.h"

namespace objects {

namespace {

constexpr size_t kFewSteps = 32;  ///< visibilities with no more stay exact
constexpr float kInfinity = std::numeric_limits<float>::infinity();

float rounded_up(double value) {
    const float near = static_cast<float>(value);
    return double(near) >= value ? near : std::nextafter(near, kInfinity);
}

float rounded_down(double value) {
    return -rounded_up(-value);
}

Cluster finished(const DraftCluster& draft) {
    Cluster out;
    for (int axis = 0; axis < 3; ++axis) {
        out.box_min[axis] = rounded_down(draft.box_min[axis]);
        out.box_max[axis] = rounded_up(draft.box_max[axis]);
    }
    out.centre = 0.5f * (out.box_min + out.box_max);
    const glm::dvec3 corner = glm::max(glm::abs(glm::dvec3(out.box_max) - glm::dvec3(out.centre)),
                                       glm::abs(glm::dvec3(out.box_min) - glm::dvec3(out.centre)));
    out.radius_m = rounded_up(glm::length(corner) * (1.0 + 1e-12));
    out.size_m = rounded_up(glm::length(draft.box_max - draft.box_min));
    out.error_m = draft.error_m >= double(kNeverEnough_m) ? kNeverEnough_m : rounded_up(draft.error_m);
    out.weight_m = draft.weight_m;
    out.geometry = draft.geometry;
    out.motion = draft.motion;
    out.object = draft.object;
    out.level = static_cast<uint16_t>(draft.level);
    out.motion_class = draft.motion_class;
    return out;
}

/// Visibilities of the tree, equal ones once.
class Visibilities {
  public:
    explicit Visibilities(ClusterTree& tree) : tree_(tree) {}

    uint32_t add(const StepFunction& f) {
        uint64_t hash = f.time_s.size();
        for (size_t i = 0; i < f.time_s.size(); ++i)
            hash = lod::hash_combine(lod::hash_combine(hash, std::bit_cast<uint64_t>(f.time_s[i])),
                                     std::bit_cast<uint64_t>(f.value[i]));
        const auto [begin, end] = known_.equal_range(hash);
        for (auto it = begin; it != end; ++it) {
            if (is_equal(tree_.visibilities[it->second], f)) return it->second;
        }
        const uint32_t id = static_cast<uint32_t>(tree_.visibilities.size());
        const uint32_t first = static_cast<uint32_t>(tree_.step_time_s.size());
        double integral_s = 0.0;
        for (size_t i = 0; i < f.time_s.size(); ++i) {
            if (i > 0) integral_s += f.value[i - 1] * (f.time_s[i] - f.time_s[i - 1]);
            tree_.step_time_s.push_back(f.time_s[i]);
            tree_.step_value.push_back(f.value[i]);
            tree_.step_integral_s.push_back(integral_s);
        }
        tree_.visibilities.push_back({first, static_cast<uint32_t>(tree_.step_time_s.size())});
        known_.emplace(hash, id);
        return id;
    }

  private:
    bool is_equal(data::IndexRange range, const StepFunction& f) const {
        return range.size() == f.time_s.size() &&
               std::equal(f.time_s.begin(), f.time_s.end(), tree_.step_time_s.begin() + range.begin) &&
               std::equal(f.value.begin(), f.value.end(), tree_.step_value.begin() + range.begin);
    }

    ClusterTree& tree_;
    std::unordered_multimap<uint64_t, uint32_t> known_;
};

/// Exact sums over all objects below have served their purpose; what a run time reads has few steps.
StepFunction stored(const StepFunction& exact, double slack) {
    return exact.time_s.size() > kFewSteps ? coarsened(exact, slack) : exact;
}

StepFunction function_at(const ClusterTree& tree, uint32_t visibility) {
    const data::IndexRange range = tree.visibilities[visibility];
    return {{tree.step_time_s.begin() + range.begin, tree.step_time_s.begin() + range.end},
            {tree.step_value.begin() + range.begin, tree.step_value.begin() + range.end}};
}

/// gamma of every cluster, by the visibilities that are stored.
void settle_gamma(ClusterTree& tree) {
    for (size_t id = tree.clusters.size(); id-- > 0;) {
        Cluster& cluster = tree.clusters[id];
        if (cluster.child_count == 0) continue;
        const StepFunction own = function_at(tree, cluster.visibility);
        double gamma = 0.0;
        for (uint32_t i = cluster.first_child; i < cluster.first_child + cluster.child_count; ++i) {
            const Cluster& child = tree.clusters[i];
            const bool is_same = child.visibility == cluster.visibility;
            const double apart =
                is_same ? 0.0 : distance(own, function_at(tree, child.visibility), tree.end_s);
            gamma = std::max(gamma, double(child.gamma) + apart);
        }
        cluster.gamma = rounded_up(gamma);
    }
}

/// Those of the draft that clusters name, in its order; clusters name the tree's from then on.
void move_motions(const Draft& draft, ClusterTree& tree) {
    std::vector<uint32_t> name(draft.motions.size(), kSceneFrame);
    for (const Cluster& cluster : tree.clusters) {
        if (cluster.motion != kSceneFrame) name[cluster.motion] = 0;
    }
    for (size_t i = 0; i < name.size(); ++i) {
        if (name[i] == kSceneFrame) continue;
        const data::IndexRange motion = draft.motions[i];
        const uint32_t first = static_cast<uint32_t>(tree.keys.size());
        tree.keys.insert(tree.keys.end(), draft.scene.keys.begin() + motion.begin,
                         draft.scene.keys.begin() + motion.end);
        if (motion.size() == 1) tree.keys.back().time_s = 0.0;
        name[i] = static_cast<uint32_t>(tree.motions.size());
        tree.motions.push_back({first, static_cast<uint32_t>(tree.keys.size())});
    }
    for (Cluster& cluster : tree.clusters) {
        if (cluster.motion != kSceneFrame) cluster.motion = name[cluster.motion];
    }
}

}  // namespace

ClusterTree flatten(Draft& draft, uint32_t root) {
    ClusterTree tree;
    tree.end_s = draft.scene.end_s;
    tree.origin_site = draft.scene.origin_site;
    tree.is_on_earth = draft.scene.is_on_earth;
    tree.object_count = static_cast<uint32_t>(draft.scene.objects.size());
    draft.pool.move_to(tree);
    Visibilities visibilities(tree);
    if (root == kNone) {
        Cluster empty;
        empty.visibility = visibilities.add({{0.0}, {0.0}});
        tree.clusters.push_back(empty);
        return tree;
    }
    std::vector<uint32_t> order = {root};  // draft clusters in the tree's order
    tree.clusters.reserve(draft.clusters.size());
    tree.clusters.push_back(finished(draft.clusters[root]));
    for (uint32_t id = 0; id < order.size(); ++id) {
        DraftCluster& from = draft.clusters[order[id]];
        tree.clusters[id].visibility =
            visibilities.add(stored(draft.functions[from.visibility], draft.options.visibility_slack));
        tree.clusters[id].first_child = static_cast<uint32_t>(order.size());
        tree.clusters[id].child_count = static_cast<uint32_t>(from.children.size());
        sort_along_curve(draft, from.children);
        for (uint32_t child : from.children) {
            order.push_back(child);
            Cluster cluster = finished(draft.clusters[child]);
            cluster.parent = id;
            tree.clusters.push_back(cluster);
        }
    }
    settle_gamma(tree);
    put_in_scene_frame(draft, tree);
    move_motions(draft, tree);
    return tree;
}

}  // namespace objects
