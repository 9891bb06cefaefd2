// What the movement of a vertex is worth on the screen.
#pragma once

#include <algorithm>
#include <array>
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

/// Whether a triangle, corners relative to the eye's anchor, may be in view: no plane of the picture has all of it
/// outside.
inline bool is_in_view(const lod::AnchoredEye& eye, const std::array<glm::vec3, 3>& corners) {
    bool is_right = true, is_left = true, is_above = true, is_below = true, is_behind = true;
    for (const glm::vec3& corner : corners) {
        const glm::dvec3 seen = eye.metric.eye_from_world * (glm::dvec3(corner) - eye.eye);
        const double half_x = -seen.z * eye.metric.tan_x, half_y = -seen.z * eye.metric.tan_y;
        is_right = is_right && seen.x > half_x;
        is_left = is_left && -seen.x > half_x;
        is_above = is_above && seen.y > half_y;
        is_below = is_below && -seen.y > half_y;
        is_behind = is_behind && -seen.z < eye.metric.near_m;
    }
    return !(is_right || is_left || is_above || is_below || is_behind);
}

/// Pixels that a sphere's error is worth; 0 out of view. The bound of lod/screen_error.h.
inline double sphere_error_px(std::span<const lod::AnchoredEye> eyes, const lod::ErrorSphere& sphere) {
    const double radius = static_cast<double>(sphere.radius_m);
    double worst = 0.0;
    for (const lod::AnchoredEye& eye : eyes) {
        if (!is_in_view(eye, sphere.centre, radius)) continue;
        const glm::dvec3 centre = eye.metric.eye_from_world * (glm::dvec3(sphere.centre) - eye.eye);
        worst = std::max(worst, lod::screen_error_px(eye.metric, centre, radius, double(sphere.error_m)));
    }
    return worst;
}

/// Pixels a displacement of a diamond's vertex costs anywhere in its two triangles, whose surface goes with it, and
/// which may be in view where the vertex is not; 0 out of view. The bound of lod/screen_error.h.
/// @param around  where the diamond is shown: its place, and a radius that holds its corners where they are
inline double displacement_px(std::span<const lod::AnchoredEye> eyes, const DiamondBound& around,
                              const glm::vec3& way) {
    const double length = static_cast<double>(glm::length(way));
    if (length == 0.0) return 0.0;
    return sphere_error_px(eyes, {around.centre, around.radius_m + glm::length(way), glm::length(way)});
}

}  // namespace terrain
