// Spread: a face made as broad as what it stands for covers, as far as the limit allows.
//
//      |\               .       a triangle within the limit may be a sliver beside the tower it stands for, or a carpet over all
//      | \     ->      / \      that is between several towers; both are near enough, but show too little or too much
//      |  \           /___\.
//
// Seen from all sides a convex solid covers a quarter of its surface in the mean, a face half of its own: so a face of half the
// surface is as good as can be. Source: Cauchy's formula on projections (1841).
#pragma once

#include <functional>

#include "objects/reduction/fit.h"

namespace objects {

/// Broadens or narrows a face, moving it where it has to be, while it is asked to hold.
/// @param target     what it may have to be moved to
/// @param limit_m    > 0
/// @param wanted_m2  area it should have
/// @param holds      whether a face is near enough, proved; is asked of some ten
/// @param face       in and out; holds before, and after
/// Cost: some ten fits.
void spread(const FitTarget& target, double limit_m, double wanted_m2,
            const std::function<bool(const lod::Triangle&)>& holds, lod::Triangle& face);

}  // namespace objects
