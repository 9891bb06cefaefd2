// Cover: the large faces of a soup, as many as it takes for every other face to lie near them.
#pragma once

#include "objects/reduction/face_soup.h"

namespace objects {

/// Goes through the faces from large to small and leaves out those that lie within `limit_m` of the faces kept so far:
/// walls between parts that have grown together, backs of thin plates, small things on large ones. What is kept stays,
/// so every face left out is proved to be within the limit of the result, and the result is part of the source.
/// @param limit_m  > 0
/// @param settled  so many faces, the first, are kept unasked
/// Cost: O(n log n). Deterministic: of equal areas the first counts as larger.
FaceSoup large_cover(const FaceSoup& source, double limit_m, uint32_t settled = 0);

}  // namespace objects
