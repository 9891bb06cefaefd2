// Spread: a face made as broad as what it stands for covers, as far as the limit allows.
//
//      |\               .       a triangle within the limit may be a sliver beside the tower it stands for, or a carpet over all
//      | \     ->      / \      that is between several towers; both are near enough, but show too little or too much
//      |  \           /___\.
//
// Seen from all sides a convex solid covers a quarter of its surface in the mean, a face half of its own: so a face of half the
// surface is as good as can be. Source: Cauchy's formula on projections (1841).
#pragma once

#include <span>

#include "objects/reduction/fit.h"

namespace objects {

/// Broadens or narrows a face and moves it where it has to be.
/// @param target     what it is moved by
/// @param held       points that are within the limit of the face, and stay so
/// @param limit_m    > 0
/// @param wanted_m2  area it should have
/// @param face       in and out; stays within the limit of the target's surface, proved, if it was
/// Cost: up to eight fits and proofs. Deterministic.
void spread(const FitTarget& target, std::span<const glm::dvec3> held, double limit_m, double wanted_m2,
            lod::Triangle& face);

}  // namespace objects
