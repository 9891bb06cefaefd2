// Distance between two segments: of two points on them that are nearest, or all but.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include "lod/surface/triangle.h"

namespace lod {

/// Squared distance of segments ab and cd. Whatever rounding does, it is that of two points that lie on them.
/// Source: Ericson, Real-time collision detection (2005), 5.1.9. Differs from it in: every nearest pair of an end and
/// the other segment is tried too, so that nearly parallel ones lose nothing.
inline double squared_segment_distance(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                       const glm::dvec3& d) {
    double least = std::min(
        {squared_distance(a, nearest_on_segment(a, c, d)), squared_distance(b, nearest_on_segment(b, c, d)),
         squared_distance(c, nearest_on_segment(c, a, b)), squared_distance(d, nearest_on_segment(d, a, b))});
    const glm::dvec3 ab = b - a, cd = d - c;
    const glm::dvec3 across = glm::cross(ab, cd);
    const double size2 = glm::dot(across, across);
    if (!(size2 > 1e-24 * glm::dot(ab, ab) * glm::dot(cd, cd))) return least;
    const double share_ab = glm::dot(glm::cross(c - a, cd), across) / size2;
    const double share_cd = glm::dot(glm::cross(c - a, ab), across) / size2;
    if (share_ab < 0.0 || share_ab > 1.0 || share_cd < 0.0 || share_cd > 1.0) return least;
    const double apart = glm::dot(c - a, across);
    return std::min(least, apart * apart / size2);
}

}  // namespace lod
