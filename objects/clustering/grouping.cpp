#include "objects/clustering/grouping.h"

#include <algorithm>
#include <utility>

#include "lod/base/hilbert3.h"

namespace objects {

namespace {

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

bool GrowingBox::take(const Box& other, double most_m) {
    const Box joined{glm::min(box.low, other.low), glm::max(box.high, other.high)};
    if (glm::length(joined.high - joined.low) > most_m) return false;
    box = joined;
    return true;
}

Grouping group_neighbours(const Draft& draft, std::span<const uint32_t> active, const LevelThresholds& at) {
    std::vector<uint32_t> order(active.begin(), active.end());
    sort_along_curve(draft, order);
    AliveTree tree(places_of(draft, order, at));
    GrowingBox group;
    uint32_t visibility = 0;
    uint64_t steps = 0;
    const auto begin = [&](uint32_t representative) {
        const DraftCluster& cluster = draft.clusters[representative];
        group.box = {cluster.box_min, cluster.box_max};
        visibility = cluster.visibility;
    };
    const auto takes = [&](uint32_t neighbour) {
        const DraftCluster& cluster = draft.clusters[neighbour];
        if (cluster.visibility != visibility) {
            const StepFunction &own = draft.functions[visibility],
                               &other = draft.functions[cluster.visibility];
            steps += own.time_s.size() + other.time_s.size();
            if (distance(own, other, draft.scene.end_s) > at.gamma) return false;
        }
        return group.take({cluster.box_min, cluster.box_max}, at.size_m);
    };
    Grouping out = gather_groups(order, tree, draft.options.most_children, begin, takes);
    out.counts.steps = steps;
    return out;
}

}  // namespace objects
