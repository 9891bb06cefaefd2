// FacingRanges: which of a geometry's triangles an eye can see at all.
#pragma once

#include "objects/cluster_tree.h"

namespace objects {

/// Whether the eye lies behind every face of a range: then solids hide all of them from it, and themselves nothing.
/// @param eye  from the geometry's centre, in its frame, metres
bool looks_away(const FacingRange& range, const glm::dvec3& eye);

/// Indices of one geometry, glass left out.
struct IndexSpan {
    uint32_t first = 0, count = 0;
};

/// Appends the spans that may show, ascending; short gaps between them are drawn along. Everything when the eye is nearer
/// than `clear_m` to the geometry, as it may be inside a solid then, or cut into it.
/// @param eye_geometry  in the geometry's frame, metres
void visible_spans(const ClusterTree& tree, const ClusterGeometry& geometry, const glm::dvec3& eye_geometry,
                   double clear_m, std::vector<IndexSpan>& out);

}  // namespace objects
