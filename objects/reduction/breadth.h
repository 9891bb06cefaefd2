// Breadth: what is thin keeps how much it covers, not only where it is.
//
// A mast within the limit of its axis may be reduced to slivers without area, or to a few faces with gaps as long as the
// limit between them. That is near enough, but hardly a pixel's middle meets it: cranes look dotted from afar, then
// vanish. A face that stands for more surface than it has, where that is long and thin, becomes a twisted card
// (twisted_card.h) as long as what it stands for is spread, and as broad as that covers, averaged over all directions
// across the axis.
#pragma once

#include "lod/surface/triangle_tree.h"
#include "objects/reduction/nearest_faces.h"

namespace objects {

/// Replaces such faces of `result` by cards where these lie within the limit of `source`; the distance of the two surfaces
/// stays within `limit_m`, proved.
/// @param source_tree  of `source`
/// @param nearest      faces of `result` near those of `source`, within the limit
/// @param result       its Hausdorff distance to `source` is proved to be at most `limit_m`
/// Cost: O(n log n), that of one more proof where anything is thin.
void keep_breadth(const FaceSoup& source, const lod::TriangleTree& source_tree, const NearestFaces& nearest,
                  double limit_m, FaceSoup& result);

}  // namespace objects
