// The build of a cluster tree from a timed scene.
//
//     leaves   one an object, or one a stay of an object that moves between rests (stays.h); meshes, visibilities and
//              motions that are equal are stored once
//     levels   on each, representatives along a Hilbert curve gather neighbours in space and time; groups become
//              clusters, geometry joined and reduced to a proved bound
//     movers   objects with equal key frames are one body and have a hierarchy in its frame; bodies get reduced parents;
//              those that keep their places in one another's frame become convoys (convoys.h); above them are clusters
//              that only hold, by swept boxes and by time
//     tree     the virtual root over static, pseudo-dynamic and moving
//
// Sources: Semenov, Shutkin, Zolotov et al. (2020), section 3. Differs from it in: thresholds double from level to level
// unless asked otherwise; what stands alone is reduced alone; moving objects have
// parents, and are pseudo-dynamic while they rest.
#pragma once

#include <functional>

#include "objects/cluster_tree.h"
#include "objects/clustering/build_counts.h"
#include "objects/clustering/build_options.h"

namespace objects {

/// How far a build has come.
struct BuildState {
    uint32_t level = 0;   ///< the last one done
    size_t clusters = 0;  ///< so far, leaves included
    BuildCounts counts;   ///< so far
};
using BuildProgress = std::function<void(const BuildState&)>;  ///< told after each level

/// @param scene  as data::check_timed_scene wants it
/// @returns      a tree in which every object that is there at a time is there in exactly one leaf; the same for any
///               number of threads
/// Cost: O(n log n); figures in docs/hdlod.md.
ClusterTree build_cluster_tree(const data::TimedScene& scene, BuildOptions options,
                               const BuildProgress& progress = {});

}  // namespace objects
