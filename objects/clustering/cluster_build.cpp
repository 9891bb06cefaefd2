#include "objects/clustering/cluster_build.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "objects/clustering/flatten.h"
#include "objects/clustering/grouping.h"
#include "objects/clustering/merge.h"

namespace objects {

namespace {

constexpr uint32_t kMostLevels = 24;
constexpr double kFirstSizes = 9.5;  ///< w(1) in usual objects, whatever the scene's size

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
        options.fine_levels = 0;
        options.levels_per_doubling = 1;
        return;
    }
    const double usual = sizes.empty() ? largest : mean_of_middle_half(sizes);
    const double first_m = kFirstSizes * usual;
    const double doublings =
        std::clamp(std::ceil(std::log2(draft.size_m / first_m)), 0.0, double(kMostLevels - 1));
    options.levels = options.fine_levels + options.levels_per_doubling * static_cast<uint32_t>(doublings) + 1;
    draft.size_m = std::max(draft.size_m, std::exp2(doublings) * first_m);
}

/// Levels of one frame up to a single top.
/// @param active  clusters of one frame, at least one
uint32_t build_hierarchy(Draft& draft, std::vector<uint32_t> active, const HierarchyFrame& frame,
                         const BuildProgress& progress) {
    for (uint32_t level = 1; level <= draft.options.levels || active.size() > 1; ++level) {
        const Grouping grouping = merges(draft.options, level)
                                      ? group_neighbours(draft, active, draft.at(level))
                                      : Grouping{.groups = {}, .waiting = active, .counts = {}};
        draft.counts.add(grouping.counts);
        std::vector<uint32_t> released = grouping.waiting;
        std::vector<uint32_t> next = merge_groups(draft, grouping.groups, level, frame, released);
        const std::vector<uint32_t> alone = reduce_alone(draft, released, level, frame);
        next.insert(next.end(), alone.begin(), alone.end());
        active = std::move(next);
        if (progress) progress({level, draft.clusters.size(), draft.counts});
    }
    return active[0];
}

/// Where a body can be: the boxes of its middle's path, wide enough for any turn.
void sweep(const Draft& draft, uint32_t top, glm::dvec3& low, glm::dvec3& high) {
    const DraftCluster& body = draft.clusters[top];
    const glm::dvec3 reach = glm::max(glm::abs(body.box_min), glm::abs(body.box_max));
    const double radius = glm::length(reach);
    const data::IndexRange motion = draft.motions[body.motion];
    for (uint32_t i = motion.begin; i < motion.end; ++i) {
        const glm::dvec3 at = draft.scene.keys[i].position;
        low = i == motion.begin ? at - radius : glm::min(low, at - radius);
        high = i == motion.begin ? at + radius : glm::max(high, at + radius);
    }
}

/// Movers by body: objects with one motion are one body.
uint32_t build_movers(Draft& draft, const std::vector<uint32_t>& movers, const BuildProgress& progress) {
    std::map<uint32_t, std::vector<uint32_t>> bodies;
    for (uint32_t id : movers)
        bodies[draft.clusters[id].motion].push_back(id);
    std::vector<uint32_t> tops;
    for (auto& [motion, members] : bodies)
        tops.push_back(build_hierarchy(draft, members, {motion, data::MotionClass::kDynamic}, {}));
    // Holders live in the scene frame: from here on a body's place is where its path goes.
    for (uint32_t& top : tops) {
        const uint32_t holder =
            hold(draft, {top}, draft.clusters[top].level + 1, data::MotionClass::kDynamic);
        sweep(draft, top, draft.clusters[holder].box_min, draft.clusters[holder].box_max);
        top = holder;
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
        if (!members.empty())
            tops.push_back(build_hierarchy(draft, members, {kSceneFrame, motion_class}, progress));
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
