// Distance between two segments: of two points on them that are nearest, or all but.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include "lod/surface/triangle.h"

namespace lod {

/// Squared distance of segments ab and cd. Whatever rounding does, it is that of two points on them, or next to them by
/// no more than rounding.
/// Source: Ericson, Real-time collision detection (2005), 5.1.9. Differs from it in: where the lines' nearest points are
/// not both inside, or all but parallel, all four pairs of an end and the other segment are tried.
inline double squared_segment_distance(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                       const glm::dvec3& d) {
    const glm::dvec3 ab = b - a, cd = d - c, ac = c - a;
    const glm::dvec3 across = glm::cross(ab, cd);
    const double size2 = glm::dot(across, across);
    if (size2 > 1e-24 * glm::dot(ab, ab) * glm::dot(cd, cd)) {
        const double share_ab = glm::dot(glm::cross(ac, cd), across),
                     share_cd = glm::dot(glm::cross(ac, ab), across);
        if (share_ab >= 0.0 && share_ab <= size2 && share_cd >= 0.0 && share_cd <= size2) {
            const double apart = glm::dot(ac, across);
            return apart * apart / size2;
        }
    }
    return std::min(
        {squared_distance(a, nearest_on_segment(a, c, d)), squared_distance(b, nearest_on_segment(b, c, d)),
         squared_distance(c, nearest_on_segment(c, a, b)), squared_distance(d, nearest_on_segment(d, a, b))});
}

/// Squared distance of two points on segments ab and cd that are nearest, or not far from it: never less than the
/// segments' own. A third of squared_segment_distance's cost.
/// Source: as above; Differs from it in: the second point is not asked for the first's place again.
inline double squared_distance_of_pair(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                       const glm::dvec3& d) {
    const glm::dvec3 ab = b - a, cd = d - c, ca = a - c;
    const double ab2 = glm::dot(ab, ab), cd2 = glm::dot(cd, cd), both = glm::dot(ab, cd);
    const double ab_ca = glm::dot(ab, ca), cd_ca = glm::dot(cd, ca);
    const double size2 = ab2 * cd2 - both * both;
    const double share_ab = size2 > 0.0 ? std::clamp((both * cd_ca - ab_ca * cd2) / size2, 0.0, 1.0) : 0.5;
    const double share_cd = cd2 > 0.0 ? std::clamp((both * share_ab + cd_ca) / cd2, 0.0, 1.0) : 0.0;
    return squared_distance(a + share_ab * ab, c + share_cd * cd);
}

}  // namespace lod
