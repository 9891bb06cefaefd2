#include "objects/clustering/grouping.h"

#include <algorithm>
#include <utility>

#include "lod/base/hilbert3.h"
#include "objects/clustering/alive_tree.h"

namespace objects {

namespace {

constexpr size_t kCandidatesPerChild = 2;  ///< neighbours looked at for each that a cluster may have

glm::dvec3 middle_of(const DraftCluster& cluster) {
    return 0.5 * (cluster.box_min + cluster.box_max);
}

/// Coordinates in which neighbours are nearer than about 1.
std::vector<PlaceAndTime> places_of(const Draft& draft, std::span<const uint32_t> active,
                                    const LevelThresholds& at) {
    std::vector<PlaceAndTime> places(active.size());
    const double per_second = 1.0 / std::max(at.gamma * draft.scene.end_s, 1e-300);
    const double per_metre = 1.0 / std::max(at.size_m, 1e-300);
    for (size_t i = 0; i < active.size(); ++i) {
        const DraftCluster& cluster = draft.clusters[active[i]];
        const glm::dvec3 middle = per_metre * middle_of(cluster);
        const MeanTimes times = mean_times(draft.functions[cluster.visibility], draft.scene.end_s);
        places[i] = {middle.x, middle.y, middle.z, per_second * times.rise_s, per_second * times.fall_s};
    }
    return places;
}

/// The box of a group as it grows.
struct GrowingBox {
    glm::dvec3 low, high;

    bool take(const DraftCluster& cluster, double most_m) {
        const glm::dvec3 new_low = glm::min(low, cluster.box_min), new_high = glm::max(high, cluster.box_max);
        if (glm::length(new_high - new_low) > most_m) return false;
        low = new_low;
        high = new_high;
        return true;
    }
};

}  // namespace

void sort_along_curve(const Draft& draft, std::vector<uint32_t>& clusters) {
    if (clusters.empty()) return;
    glm::dvec3 low = middle_of(draft.clusters[clusters[0]]), high = low;
    for (uint32_t id : clusters) {
        low = glm::min(low, middle_of(draft.clusters[id]));
        high = glm::max(high, middle_of(draft.clusters[id]));
    }
    const glm::dvec3 extent = high - low;
    const double side = std::max({extent.x, extent.y, extent.z, 1e-9});
    std::vector<std::pair<uint64_t, uint32_t>> keys;
    keys.reserve(clusters.size());
    for (uint32_t id : clusters) {
        const glm::dvec3 cell = (middle_of(draft.clusters[id]) - low) * (double((1u << 21) - 1) / side);
        keys.emplace_back(lod::hilbert_index(uint32_t(cell.x), uint32_t(cell.y), uint32_t(cell.z)), id);
    }
    std::sort(keys.begin(), keys.end());
    for (size_t i = 0; i < keys.size(); ++i)
        clusters[i] = keys[i].second;
}

Grouping group_neighbours(const Draft& draft, std::span<const uint32_t> active, const LevelThresholds& at) {
    std::vector<uint32_t> order(active.begin(), active.end());
    sort_along_curve(draft, order);
    AliveTree tree(places_of(draft, order, at));
    Grouping out;
    std::vector<uint32_t> near;
    const size_t most = draft.options.most_children - 1;
    for (uint32_t i = 0; i < order.size(); ++i) {
        if (!tree.is_alive(i)) continue;
        tree.remove(i);
        const DraftCluster& representative = draft.clusters[order[i]];
        const StepFunction& visibility = draft.functions[representative.visibility];
        GrowingBox box{representative.box_min, representative.box_max};
        std::vector<uint32_t> group = {order[i]};
        out.counts.nodes += tree.nearest(i, 2.0, kCandidatesPerChild * most, near);
        for (uint32_t candidate : near) {
            if (group.size() > most) break;
            const DraftCluster& neighbour = draft.clusters[order[candidate]];
            const StepFunction& other = draft.functions[neighbour.visibility];
            if (neighbour.visibility != representative.visibility) {
                out.counts.steps += visibility.time_s.size() + other.time_s.size();
                if (distance(visibility, other, draft.scene.end_s) > at.gamma) continue;
            }
            if (!box.take(neighbour, at.size_m)) continue;
            group.push_back(order[candidate]);
            tree.remove(candidate);
        }
        if (group.size() == 1)
            out.waiting.push_back(order[i]);
        else
            out.groups.push_back(std::move(group));
    }
    return out;
}

}  // namespace objects
