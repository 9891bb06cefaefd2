// What the movement of a vertex is worth on the screen.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <span>

#include "lod/screen_error.h"
#include "lod/sight_metric.h"

namespace terrain {

/// Pixels a displacement costs at a place in view; 0 out of view. The bound of lod/screen_error.h.
inline double displacement_px(std::span<const lod::AnchoredEye> eyes, const glm::vec3& place,
                              const glm::vec3& way) {
    const double length = static_cast<double>(glm::length(way));
    if (length == 0.0) return 0.0;
    double worst = 0.0;
    for (const lod::AnchoredEye& eye : eyes) {
        const glm::dvec3 centre = eye.metric.eye_from_world * (glm::dvec3(place) - eye.eye);
        if (lod::distance_outside_m(eye.metric, centre, length) > 0.0) continue;
        worst = std::max(worst, lod::screen_error_px(eye.metric, centre, length, length));
    }
    return worst;
}

}  // namespace terrain
