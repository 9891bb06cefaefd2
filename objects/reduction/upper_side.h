// Upper side: what is open is seen from both sides in the light of one, and ground and roofs are looked at from above.
#pragma once

#include "objects/reduction/face_soup.h"

namespace objects {

/// Turns those faces of open parts that look down, but walls; closed parts, which show one side only, stay. The surface stays.
/// @param cell_m  > 0; points that near to each other hold a part together
/// Cost: O(n log n).
void turn_open_parts_up(double cell_m, FaceSoup& soup);

}  // namespace objects
