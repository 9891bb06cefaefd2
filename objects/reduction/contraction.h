// Contraction: a soup loses points, pair by pair, the cheapest pair first, until every pair left costs too much.
//
// Pairs are edges and, so that parts which merely lie close grow together, points within reach of each other. What a
// pair costs is how far the new point is from the planes of either side, root mean square, the worse side counting: a
// guess at the error, and not more. Whoever wants a bound measures the outcome (reduce.h). A part (a connected piece)
// keeps at least one face.
//
// Source: Garland, Heckbert, Surface simplification using quadric error metrics (1997). Differs from it in: sides are
// judged apart, so that a small part is not outvoted by a large one; no topology is kept.
#pragma once

#include <vector>

#include "objects/reduction/face_soup.h"

namespace objects {

struct ContractionReach {
    double close_m = 0.0;    ///< points this near to each other are pairs, edge or not; 0: edges only
    double longest_m = 0.0;  ///< no pair is longer; 0: any length
};

/// @param soup         no collapsed faces; may have repeated ones
/// @param tolerance_m  [points] what a pair with this point may cost; 0: only what lies in the planes exactly
/// @returns            points as in the input, by index, those that became one all but one unused
/// Cost: O(n log n), 1 to 2 us a point. Deterministic.
FaceSoup contract(const FaceSoup& soup, const std::vector<double>& tolerance_m,
                  const ContractionReach& reach);

}  // namespace objects
