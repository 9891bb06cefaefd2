// A small random cluster tree, made without the builder: any hierarchy, visibilities that are weighted means, some
// branches of moving leaves.
#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "lod/base/rng.h"
#include "objects/cluster_tree.h"

namespace objects {

class RandomClusters {
  public:
    RandomClusters(uint64_t seed, uint32_t leaf_count, double end_s) : rng_(seed) {
        tree_.end_s = end_s;
        tree_.object_count = leaf_count;
        std::vector<Node> level;
        for (uint32_t i = 0; i < leaf_count; ++i)
            level.push_back(leaf(i));
        while (level.size() > 1)
            level = group(level);
        place(level[0]);
    }

    const ClusterTree& tree() const { return tree_; }

  private:
    using Steps = std::vector<std::pair<double, double>>;  ///< from a time on, a value
    struct Node {
        Cluster cluster;
        Steps steps;
        std::vector<Node> children;
    };

    static double value_at(const Steps& steps, double time_s) {
        double value = steps[0].second;
        for (const auto& [begin_s, v] : steps)
            value = begin_s <= time_s ? v : value;
        return value;
    }

    uint32_t add_geometry() {
        const auto triangles = static_cast<uint32_t>(1 + rng_.below(9));
        const auto glass = static_cast<uint32_t>(rng_.below(4) == 0 ? 1 : 0);
        tree_.geometries.push_back({static_cast<uint32_t>(tree_.vertices.size()), 3,
                                    static_cast<uint32_t>(tree_.indices.size()), 3 * triangles, 3 * glass});
        for (int corner = 0; corner < 3; ++corner)
            tree_.vertices.push_back(
                lod::make_vertex({corner, 0, 0}, {0, 0, 1}, {200, 200, 200}, lod::Material::kPaint));
        for (uint32_t i = 0; i < 3 * triangles; ++i)
            tree_.indices.push_back(i % 3);
        return static_cast<uint32_t>(tree_.geometries.size() - 1);
    }

    void set_box(Cluster& cluster, const glm::vec3& low, const glm::vec3& high) {
        cluster.box_min = low;
        cluster.box_max = high;
        cluster.centre = (low + high) * 0.5f;
        cluster.size_m = glm::distance(low, high) * 1.0001f;
        cluster.radius_m = 0.5f * cluster.size_m;
    }

    glm::vec3 point(double reach) {
        const double x = rng_.between(-reach, reach), y = rng_.between(-reach, reach),
                     z = rng_.between(0, 50);
        return {x, y, z};
    }

    Node leaf(uint32_t object) {
        Node node;
        const glm::vec3 centre = point(500.0), half = glm::vec3(0.5f) + 0.02f * glm::abs(point(200.0));
        set_box(node.cluster, centre - half, centre + half);
        node.cluster.weight_m = node.cluster.size_m;
        node.cluster.object = object;
        node.cluster.geometry = add_geometry();
        switch (rng_.below(4)) {
            case 0:
                node.steps = {{0.0, 1.0}};
                break;
            case 1:
                node.steps = {{0.0, 0.0}};
                break;
            default:
                node.steps = {{0.0, double(rng_.below(2))}};
        }
        if (node.cluster.object % 2 == 0) add_events(node.steps);
        if (rng_.below(8) == 0) set_moving(node.cluster);
        return node;
    }

    void add_events(Steps& steps) {
        double time_s = 0.0;
        for (uint64_t i = rng_.below(4); i > 0; --i) {
            time_s += rng_.between(0.01, 0.4) * tree_.end_s;
            if (time_s < tree_.end_s) steps.emplace_back(time_s, 1.0 - steps.back().second);
        }
    }

    void set_moving(Cluster& cluster) {
        const glm::vec3 half = (cluster.box_max - cluster.box_min) * 0.5f;
        cluster.motion = static_cast<uint32_t>(tree_.motions.size());
        cluster.motion_class = data::MotionClass::kDynamic;
        const auto begin = static_cast<uint32_t>(tree_.keys.size());
        for (uint64_t i = 0, count = 2 + rng_.below(3); i < count; ++i) {
            const glm::dquat turn = glm::angleAxis(rng_.between(-3.0, 3.0), glm::dvec3(0.0, 0.0, 1.0));
            tree_.keys.push_back({double(i) * 0.3 * tree_.end_s, glm::dvec3(point(400.0)), turn});
        }
        tree_.motions.push_back({begin, static_cast<uint32_t>(tree_.keys.size())});
        set_box(cluster, -half, half);
    }

    std::vector<Node> group(std::vector<Node>& level) {
        std::vector<Node> above;
        for (size_t begin = 0; begin < level.size();) {
            const size_t count = std::min<size_t>(level.size() - begin, 2 + rng_.below(6));
            above.push_back(parent({level.begin() + long(begin), level.begin() + long(begin + count)}));
            begin += count;
        }
        return above;
    }

    Node parent(std::vector<Node> children) {
        Node node;
        glm::vec3 low(1e9f), high(-1e9f);
        std::map<double, double> times;
        for (const Node& child : children) {
            // Whatever moves stays within this.
            const bool moves = child.cluster.motion != kSceneFrame;
            low = glm::min(low, moves ? glm::vec3(-450.0f) : child.cluster.box_min);
            high = glm::max(high, moves ? glm::vec3(450.0f) : child.cluster.box_max);
            node.cluster.weight_m += child.cluster.weight_m;
            node.cluster.error_m = std::max(node.cluster.error_m, child.cluster.error_m);
            node.cluster.level = std::max<uint16_t>(node.cluster.level, child.cluster.level);
            for (const auto& [time_s, value] : child.steps)
                times[time_s] = 0.0;
        }
        ++node.cluster.level;
        set_box(node.cluster, low, high);
        node.cluster.error_m += static_cast<float>(rng_.between(0.0, 2.0));
        node.cluster.geometry = rng_.below(6) == 0 ? kNoGeometry : add_geometry();
        if (node.cluster.geometry == kNoGeometry) node.cluster.error_m = kNeverEnough_m;
        for (auto& [time_s, value] : times) {
            double there = 0.0;
            for (const Node& child : children)
                there += child.cluster.weight_m * value_at(child.steps, time_s);
            value = there == node.cluster.weight_m ? 1.0 : there / node.cluster.weight_m;
            if (node.steps.empty() || node.steps.back().second != value)
                node.steps.emplace_back(time_s, value);
        }
        node.children = std::move(children);
        return node;
    }

    /// Breadth first: siblings lie together, below their parent.
    void place(const Node& root) {
        std::vector<const Node*> queue{&root};
        tree_.clusters.push_back(filed(root, kNoCluster));
        for (size_t i = 0; i < queue.size(); ++i) {
            tree_.clusters[i].first_child = static_cast<ClusterId>(tree_.clusters.size());
            tree_.clusters[i].child_count = static_cast<uint32_t>(queue[i]->children.size());
            for (const Node& child : queue[i]->children) {
                tree_.clusters.push_back(filed(child, static_cast<ClusterId>(i)));
                queue.push_back(&child);
            }
        }
    }

    Cluster filed(const Node& node, ClusterId parent) {
        Cluster cluster = node.cluster;
        cluster.parent = parent;
        cluster.visibility = static_cast<uint32_t>(tree_.visibilities.size());
        const auto begin = static_cast<uint32_t>(tree_.step_time_s.size());
        for (const auto& [time_s, value] : node.steps) {
            const double before = tree_.step_time_s.size() == begin
                                      ? 0.0
                                      : tree_.step_integral_s.back() +
                                            tree_.step_value.back() * (time_s - tree_.step_time_s.back());
            tree_.step_time_s.push_back(time_s);
            tree_.step_value.push_back(value);
            tree_.step_integral_s.push_back(before);
        }
        tree_.visibilities.push_back({begin, static_cast<uint32_t>(tree_.step_time_s.size())});
        return cluster;
    }

    lod::Rng rng_;
    ClusterTree tree_;
};

}  // namespace objects
