// What the movement of a vertex is worth on the screen.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <span>

#include "lod/screen_error.h"
#include "lod/sight_metric.h"
#include "terrain/diamond_bound.h"

namespace terrain {

/// Whether an eye may see something of a sphere around a diamond's vertex.
inline bool is_in_view(const lod::AnchoredEye& eye, const glm::vec3& centre, double radius_m) {
    const glm::dvec3 seen = eye.metric.eye_from_world * (glm::dvec3(centre) - eye.eye);
    return lod::distance_outside_m(eye.metric, seen, radius_m) <= 0.0;
}

/// Pixels a displacement of a diamond's vertex costs anywhere in its two triangles, whose surface goes with it, and
/// which may be in view where the vertex is not; 0 out of view. The bound of lod/screen_error.h.
/// @param around  where the diamond is shown: its place, and a radius that holds its corners where they are
inline double displacement_px(std::span<const lod::AnchoredEye> eyes, const DiamondBound& around,
                              const glm::vec3& way) {
    const double length = static_cast<double>(glm::length(way));
    if (length == 0.0) return 0.0;
    const double radius = static_cast<double>(around.radius_m) + length;
    double worst = 0.0;
    for (const lod::AnchoredEye& eye : eyes) {
        if (!is_in_view(eye, around.centre, radius)) continue;
        const glm::dvec3 centre = eye.metric.eye_from_world * (glm::dvec3(around.centre) - eye.eye);
        worst = std::max(worst, lod::screen_error_px(eye.metric, centre, radius, length));
    }
    return worst;
}

}  // namespace terrain
