// Reduction to a proved bound: fewer faces, and no point of either surface farther than a limit from the other.
//
// Cover (cover.h) and contraction (contraction.h) propose; the two-sided surface distance
// (lod/surface/surface_distance.h) judges every face of both surfaces. What fails is mended with the source's own faces,
// which are at distance 0. So the result always holds, and at worst is the source. What is thin keeps its breadth (breadth.h).
#pragma once

#include "objects/reduction/face_soup.h"

namespace objects {

/// @param source   any soup; collapsed and repeated faces are welcome
/// @param limit_m  > 0
/// @returns        a soup whose Hausdorff distance to `source` is proved to be at most `limit_m`, with fewer faces;
///                 or the source itself. No face only if the source has none
/// @param threads  at least 1; the result is the same for any
/// Cost: O(n log n); 5 to 20 us a face. Deterministic.
FaceSoup reduce_within(const FaceSoup& source, double limit_m, unsigned threads = 1);

}  // namespace objects
