// PartShapes: what may stand for a part that is nearly a prism, of few faces, near enough by its looks; none is proved.
//
//     spike 1, leaning pair 2, sheet 2, card 2, tents 4 and 5, lids, prisms 8 and more faces
#pragma once

#include <vector>

#include "objects/reduction/face_soup.h"
#include "objects/reduction/seen_part.h"

namespace objects {

/// What may stand for a part, and the same surface in faces that are easier to prove. Without colours.
struct PartShape {
    FaceSoup soup, pieces;
    bool is_card = false;           ///< twisted: what is slender, seen from all sides
    bool is_loose = false;          ///< faces that share no corners: may be moved to fit (fit.h)
    bool is_for_gathering = false;  ///< not broad enough where it stands alone
};

/// Appends shapes along one axis that may do, of each kind with the fewest faces first; in the part's frame, metres.
/// @param faces    of the part: closed prisms have fewer
/// @param limit_m  > 0: as far as they may be off
void propose_shapes(const SeenPart& seen, size_t faces, double limit_m, std::vector<PartShape>& out);

}  // namespace objects
