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

}  // namespace lod
