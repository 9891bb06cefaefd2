// DISPLAY: the reference traversal of a cluster tree. Stateless and simple; what the front (cluster_front.h) converges
// to at the same tolerance.
#pragma once

#include <span>
#include <vector>

#include "objects/scene_view.h"

namespace objects {

/// Appends the clusters to draw, depth first: of every branch that is there at `time_s` and in view, the first cluster
/// that costs at most `tolerance_px`, when at least half of it is there.
///
/// @param drawn  cleared first
/// @returns the largest error of what the traversal ended at, drawn or not, px
/// Source: Semenov, Shutkin, Zolotov et al. (2020), appendix 1. Differs from it in: the error is in pixels, taken at
/// the worst corner of the box (lod/screen_error.h).
double display(const ClusterTree& tree, std::span<const SceneView> views, double time_s, double tolerance_px,
               std::vector<ClusterId>& drawn);

}  // namespace objects
