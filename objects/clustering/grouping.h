// Grouping: which clusters of a level become one: neighbours in space and in time of representatives along a Hilbert
// curve.
//
// Source: Semenov, Shutkin, Zolotov et al. (2020), section 3 and appendix 2. Differs from it in: neighbours come from one
// k-d tree over place and time instead of sorted coordinates.
#pragma once

#include <span>
#include <vector>

#include "objects/clustering/draft.h"

namespace objects {

/// What a level makes of the clusters it was given.
struct Grouping {
    std::vector<std::vector<uint32_t>> groups;  ///< the representative first, then neighbours, nearest first
    std::vector<uint32_t> waiting;              ///< found no neighbour
    BuildCounts counts;
};

/// @param active   distinct clusters of one frame
/// @param at       what a group may be: its box no larger than size_m, visibilities of its neighbours no farther than
///                 gamma from the representative's
Grouping group_neighbours(const Draft& draft, std::span<const uint32_t> active, const LevelThresholds& at);

/// Clusters in the order of a Hilbert curve through their middles; equal places by number.
void sort_along_curve(const Draft& draft, std::vector<uint32_t>& clusters);

}  // namespace objects
