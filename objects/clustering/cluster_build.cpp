#include "objects/clustering/cluster_build.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "lod/base/check.h"
#include "objects/clustering/convoys.h"
#include "objects/clustering/flatten.h"
#include "objects/clustering/grouping.h"
#include "objects/clustering/merge.h"

namespace objects {

namespace {

constexpr uint32_t kMostLevels = 24;

/// Of values in any order: what most of them are near to, without a jump where two kinds are equally many.
double mean_of_middle_half(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const size_t begin = values.size() / 4, end = values.size() - begin;
    return std::accumulate(values.begin() + static_cast<std::ptrdiff_t>(begin),
                           values.begin() + static_cast<std::ptrdiff_t>(end), 0.0) /
           static_cast<double>(end - begin);
}

/// W: the extent of everything, and levels. Unless asked for so many, they double from the size most objects have until
/// they hold the scene, and W is rounded up to that: an object of a large scene is treated like one of a small scene.
void settle_levels(Draft& draft) {
    std::vector<double> sizes;
    bool is_first = true;
    glm::dvec3 low(0.0), high(0.0);
    for (const DraftCluster& leaf : draft.clusters) {
        if (leaf.motion_class == data::MotionClass::kDynamic || leaf.size_m() == 0.0) continue;
        sizes.push_back(leaf.size_m());
        low = is_first ? leaf.box_min : glm::min(low, leaf.box_min);
        high = is_first ? leaf.box_max : glm::max(high, leaf.box_max);
        is_first = false;
    }
    for (const DraftCluster& leaf : draft.clusters) {
        if (leaf.motion_class == data::MotionClass::kDynamic && leaf.size_m() > 0.0)
            sizes.push_back(leaf.size_m());
    }
    const double largest = sizes.empty() ? 1.0 : *std::max_element(sizes.begin(), sizes.end());
    draft.size_m = std::max({glm::length(high - low), largest, 1e-6});
    BuildOptions& options = draft.options;
    if (options.levels > 0) {
        options.fine_doublings = 0;
        options.levels_per_doubling = 1;
        return;
    }
    const double usual = sizes.empty() ? largest : mean_of_middle_half(sizes);
    const double first_m = options.first_sizes * usual;
    const double doublings =
        std::clamp(std::ceil(std::log2(draft.size_m / first_m)), 0.0, double(kMostLevels - 1));
    options.levels =
        fine_levels(options) + options.levels_per_doubling * static_cast<uint32_t>(doublings) + 1;
    draft.size_m = std::max(draft.size_m, std::exp2(doublings) * first_m);
}

/// What a level makes of the clusters of one frame.
std::vector<uint32_t> raise_level(Draft& draft, const std::vector<uint32_t>& active, uint32_t level) {
    const Grouping grouping = merges(draft.options, level)
                                  ? group_neighbours(draft, active, draft.at(level))
                                  : Grouping{.groups = {}, .waiting = active, .counts = {}};
    draft.counts.add(grouping.counts);
    std::vector<uint32_t> released = grouping.waiting;
    std::vector<uint32_t> next =
        merge_groups(draft, grouping.groups, level, draft.clusters[active[0]].motion_class, released);
    const std::vector<uint32_t> alone = reduce_alone(draft, released, level);
    next.insert(next.end(), alone.begin(), alone.end());
    return next;
}

/// Levels of one frame up to a single top.
/// @param active  clusters of one frame and class, at least one
uint32_t build_hierarchy(Draft& draft, std::vector<uint32_t> active, const BuildProgress& progress) {
    for (uint32_t level = 1; level <= draft.options.levels || active.size() > 1; ++level) {
        active = raise_level(draft, active, level);
        if (progress) progress({level, draft.clusters.size(), draft.counts});
    }
    return active[0];
}

/// Objects with one motion, or several such that have become a convoy.
struct BodyName {
    uint32_t motion = 0;
    bool is_turning = false;

    auto operator<=>(const BodyName&) const = default;
};
using Bodies = std::map<BodyName, std::vector<uint32_t>>;  ///< the clusters that stand for each at a level

/// Bodies of one cluster each form convoys, or are reduced alone.
/// @param bodies    all of them
/// @param settled   bodies that a single cluster stands for since an earlier level
void raise_settled(Draft& draft, const std::vector<BodyName>& settled, uint32_t level, Bodies& bodies) {
    std::map<uint32_t, BodyName> name_of;
    std::vector<uint32_t> tops;
    for (const BodyName& name : settled) {
        tops.push_back(bodies[name][0]);
        name_of[tops.back()] = name;
    }
    const Grouping grouping = merges(draft.options, level)
                                  ? group_convoys(draft, tops, level)
                                  : Grouping{.groups = {}, .waiting = tops, .counts = {}};
    draft.counts.add(grouping.counts);
    std::vector<uint32_t> released;
    const std::vector<uint32_t> convoys =
        merge_groups(draft, grouping.groups, level, data::MotionClass::kDynamic, released);
    CHECK(released.empty());  // all are there at the same times
    for (size_t i = 0; i < convoys.size(); ++i) {
        for (uint32_t member : grouping.groups[i])
            bodies.erase(name_of[member]);
        bodies[name_of[grouping.groups[i][0]]] = {convoys[i]};
    }
    const std::vector<uint32_t> alone = reduce_alone(draft, grouping.waiting, level);
    for (size_t i = 0; i < alone.size(); ++i)
        bodies[name_of[grouping.waiting[i]]] = {alone[i]};
}

/// All levels of all bodies.
void build_bodies(Draft& draft, Bodies& bodies, const BuildProgress& progress) {
    bool is_done = false;
    for (uint32_t level = 1; level <= draft.options.levels || !is_done; ++level) {
        std::vector<BodyName> settled, growing;
        for (const auto& [name, active] : bodies)
            (active.size() == 1 ? settled : growing).push_back(name);
        if (level <= draft.options.levels) raise_settled(draft, settled, level, bodies);
        is_done = true;
        for (const BodyName& name : growing) {
            bodies[name] = raise_level(draft, bodies[name], level);
            is_done = is_done && bodies[name].size() == 1;
        }
        if (progress) progress({level, draft.clusters.size(), draft.counts});
    }
}

/// Movers by body; above bodies are clusters that only hold them.
uint32_t build_movers(Draft& draft, const std::vector<uint32_t>& movers, const BuildProgress& progress) {
    Bodies bodies;
    for (uint32_t id : movers)
        bodies[{draft.clusters[id].motion, draft.clusters[id].is_turning}].push_back(id);
    build_bodies(draft, bodies, progress);
    // Holders live in the scene frame: from here on a body's place is where its path goes.
    std::vector<uint32_t> tops;
    for (const auto& [name, active] : bodies) {
        const uint32_t top = active[0];
        tops.push_back(hold(draft, {top}, draft.clusters[top].level + 1, data::MotionClass::kDynamic));
        const Box swept = swept_box(draft, draft.clusters[top]);
        draft.clusters[tops.back()].box_min = swept.low;
        draft.clusters[tops.back()].box_max = swept.high;
    }
    uint32_t level = draft.options.levels + 1;
    while (tops.size() > 1) {
        ++level;
        const Grouping grouping =
            group_neighbours(draft, tops, thresholds_at(draft.options, level, draft.size_m));
        draft.counts.add(grouping.counts);
        std::vector<uint32_t> next = grouping.waiting;
        for (const std::vector<uint32_t>& group : grouping.groups) {
            uint32_t above = 0;
            for (uint32_t child : group)
                above = std::max(above, draft.clusters[child].level + 1);
            next.push_back(hold(draft, group, std::max(above, level), data::MotionClass::kDynamic));
        }
        tops = std::move(next);
        if (progress) progress({level, draft.clusters.size(), draft.counts});
    }
    return tops[0];
}

}  // namespace

ClusterTree build_cluster_tree(const data::TimedScene& scene, BuildOptions options,
                               const BuildProgress& progress) {
    Draft draft = make_draft(scene, options);
    settle_levels(draft);
    std::vector<uint32_t> by_class[3];
    for (uint32_t i = 0; i < draft.clusters.size(); ++i)
        by_class[static_cast<size_t>(draft.clusters[i].motion_class)].push_back(i);
    std::vector<uint32_t> tops;
    for (const data::MotionClass motion_class :
         {data::MotionClass::kStatic, data::MotionClass::kPseudoDynamic}) {
        const std::vector<uint32_t>& members = by_class[static_cast<size_t>(motion_class)];
        if (!members.empty()) tops.push_back(build_hierarchy(draft, members, progress));
    }
    const std::vector<uint32_t>& movers = by_class[static_cast<size_t>(data::MotionClass::kDynamic)];
    if (!movers.empty()) tops.push_back(build_movers(draft, movers, progress));
    if (tops.empty()) return flatten(draft, kNone);
    uint32_t level = 0;
    for (uint32_t top : tops)
        level = std::max(level, draft.clusters[top].level + 1);
    return flatten(draft, hold(draft, tops, level, data::MotionClass::kStatic));
}

}  // namespace objects
