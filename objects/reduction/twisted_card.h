// TwistedCard: two faces that stand for something long and thin.
//
//         C---D        over a common edge BC, the ends at right angles to each other and to the axis, so that it is never
//          \  |        seen from its edge alone
//          |\ |
//       A--+-B
//
// A convex tube of perimeter u covers u / pi, averaged over all directions across its axis; such a card of breadth b at
// most 2 b / pi.
#pragma once

#include "objects/reduction/face_soup.h"

namespace objects {

/// Something long, its breadth a mean over what it covers seen from around.
struct Rod {
    glm::dvec3 middle{0.0}, axis{0.0, 0.0, 1.0};  ///< unit axis
    double length_m = 0.0, breadth_m = 0.0;
};

/// Corners A, B, C, D of a card as long and as broad as the rod.
std::array<glm::dvec3, 4> twisted_card(const Rod& rod);

/// Its two faces.
void append_card(const std::array<glm::dvec3, 4>& corners, const glm::u8vec4& colour, FaceSoup& out);

}  // namespace objects
