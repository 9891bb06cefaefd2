// Convoys: bodies that stay near fixed places in one another's frame become one, from afar: parts of a vehicle, what hangs
// on one hook.
//
//     carrier   o----o         its frame is the convoy's
//     members     o----o       each at a place in it, off that by its drift at most (relative_motion.h)
//
// A convoy's error is what its members' geometry is off, and their drift, and what reduction adds.
#pragma once

#include <span>

#include "objects/clustering/grouping.h"

namespace objects {

/// Groups of bodies that are there at the same times and drift by no more than a share of a level's error. The first of a
/// group is its carrier, the others have got a carriage.
/// @param bodies  tops of bodies with a motion each
Grouping group_convoys(Draft& draft, std::span<const uint32_t> bodies, uint32_t level);

/// Where a body can be: the box of its frame's path, wide enough for any turn.
Box swept_box(const Draft& draft, const DraftCluster& body);

}  // namespace objects
