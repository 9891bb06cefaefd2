// Merging: children become a cluster with a box, a visibility, and geometry reduced to what a level allows.
#pragma once

#include <span>
#include <vector>

#include "objects/clustering/draft.h"

namespace objects {

/// Adds one cluster a group, in their order: works on all threads, the outcome does not depend on how many. Children
/// that turn out too far in time for gamma(l) are let go. What moves stands in the frame of the group's first.
/// @param groups    of clusters that no cluster has as children yet, all of one class
/// @param released  appended: children that were let go
/// @returns         the new clusters
std::vector<uint32_t> merge_groups(Draft& draft, const std::vector<std::vector<uint32_t>>& groups,
                                   uint32_t level, data::MotionClass motion_class,
                                   std::vector<uint32_t>& released);

/// Puts a reduced parent over each cluster that stands alone where that saves enough of its faces.
/// @returns  for each of `alone` itself or its new parent
std::vector<uint32_t> reduce_alone(Draft& draft, std::span<const uint32_t> alone, uint32_t level);

/// A cluster that is never drawn and only holds others: for culling by place and time.
uint32_t hold(Draft& draft, const std::vector<uint32_t>& children, uint32_t level,
              data::MotionClass motion_class);

}  // namespace objects
