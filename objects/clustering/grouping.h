// Grouping: which clusters of a level become one: neighbours in space and in time of representatives along a Hilbert
// curve.
//
// Source: Semenov, Shutkin, Zolotov et al. (2020), section 3 and appendix 2. Differs from it in: neighbours come from one
// k-d tree over place and time instead of sorted coordinates.
#pragma once

#include <span>
#include <vector>

#include "objects/alive_tree.h"
#include "objects/clustering/draft.h"

namespace objects {

/// What a level makes of the clusters it was given.
struct Grouping {
    std::vector<std::vector<uint32_t>> groups;  ///< the representative first, then neighbours, nearest first
    std::vector<uint32_t> waiting;              ///< found no neighbour
    BuildCounts counts;
};

/// Boxes joined as long as they stay small.
struct GrowingBox {
    Box box;

    bool take(const Box& other, double most_m);
};

/// Representatives in order take their nearest living neighbours, as long as these suit.
/// @param order   clusters, points of `tree` in the same order; all alive
/// @param begin   begin(cluster): a new group with this representative
/// @param takes   takes(cluster): whether the group may have it, too; if so it does
template <typename Begin, typename Takes>
Grouping gather_groups(std::span<const uint32_t> order, AliveTree& tree, size_t most_children,
                       const Begin& begin, const Takes& takes) {
    constexpr size_t kCandidatesPerChild = 2;  // neighbours looked at for each that a cluster may have
    Grouping out;
    std::vector<uint32_t> near;
    const size_t most = most_children - 1;
    for (uint32_t i = 0; i < order.size(); ++i) {
        if (!tree.is_alive(i)) continue;
        tree.remove(i);
        begin(order[i]);
        std::vector<uint32_t> group = {order[i]};
        out.counts.nodes += tree.nearest(i, 2.0, kCandidatesPerChild * most, near);
        for (uint32_t candidate : near) {
            if (group.size() > most) break;
            if (!takes(order[candidate])) continue;
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

/// @param active   distinct clusters of one frame
/// @param at       what a group may be: its box no larger than size_m, visibilities of its neighbours no farther than
///                 gamma from the representative's
Grouping group_neighbours(const Draft& draft, std::span<const uint32_t> active, const LevelThresholds& at);

/// Clusters in the order of a Hilbert curve through their middles; equal places by number.
void sort_along_curve(const Draft& draft, std::vector<uint32_t>& clusters);

}  // namespace objects
