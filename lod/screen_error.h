// The one screen-error metric: how many pixels an object-space error can cost, as a bound that holds.
//
// A displacement of e metres at a point at depth z (along the line of sight) and distance d moves its image by
// at most  lambda * e / z * (d / z)  pixels: one division for the perspective, and the picture plane is slanted
// by d/z towards the corners. The usual e*lambda/d is not a bound there. With the error inside a sphere, z is
// taken at its nearest visible point and d/z at its most slanted one; with the error inside a box, mostly both at the same.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "lod/view.h"

namespace lod {

/// How far outside the picture's pyramid the sphere is, in metres; negative inside. The eye's near plane
/// counts as a side. Never more than the true distance, so it bounds how far the eye must move to see it.
inline double distance_outside_m(const ViewMetric& metric, const glm::dvec3& centre_eye, double radius_m) {
    const double depth = -centre_eye.z;
    const double x = (std::abs(centre_eye.x) - depth * metric.tan_x) * metric.cos_x;
    const double y = (std::abs(centre_eye.y) - depth * metric.tan_y) * metric.cos_y;
    return std::max({x, y, metric.near_m - depth}) - radius_m;
}

/// Upper bound, over every visible point of the sphere, of the pixels that `error_m` can move it.
///
/// @param centre_eye  eye frame, metres, finite
/// @param radius_m    >= 0; the sphere contains everything the error speaks of
/// @param error_m     >= 0
/// @returns pixels, >= 0 and finite; the frustum is not tested here (distance_outside_m does)
inline double screen_error_px(const ViewMetric& metric, const glm::dvec3& centre_eye, double radius_m,
                              double error_m) {
    const double distance = std::sqrt(glm::dot(centre_eye, centre_eye));
    const double front_depth = -centre_eye.z - radius_m;
    const double depth = std::max({front_depth, (distance - radius_m) / metric.stretch, metric.near_m});
    const double slant =
        std::min(metric.stretch, (distance + radius_m) / std::max(front_depth, metric.near_m));
    return metric.lambda_px * error_m * std::max(slant, 1.0) / depth;
}

/// Corners of a box in the eye frame, metres: [i] is at the far end of axis k where bit k of i is set; axes at right angles.
using EyeBox = std::array<glm::dvec3, 8>;

/// Whether one side of the picture's pyramid, or its near plane, has the whole box beyond it.
inline bool is_outside(const ViewMetric& metric, const EyeBox& box) {
    bool is_right = true, is_left = true, is_above = true, is_below = true, is_behind = true;
    for (const glm::dvec3& corner : box) {
        const double half_x = -corner.z * metric.tan_x, half_y = -corner.z * metric.tan_y;
        is_right = is_right && corner.x > half_x;
        is_left = is_left && -corner.x > half_x;
        is_above = is_above && corner.y > half_y;
        is_below = is_below && -corner.y > half_y;
        is_behind = is_behind && -corner.z < metric.near_m;
    }
    return is_right || is_left || is_above || is_below || is_behind;
}

/// From the eye to the nearest point of a box, metres; 0 inside.
inline double distance_to_eye_m(const EyeBox& box) {
    glm::dvec3 nearest = box[0];
    for (const size_t far : {1u, 2u, 4u}) {
        const glm::dvec3 axis = box[far] - box[0];
        const double length_2 = glm::dot(axis, axis);
        if (length_2 > 0.0) nearest += std::clamp(-glm::dot(box[0], axis) / length_2, 0.0, 1.0) * axis;
    }
    return glm::length(nearest);
}

/// Upper bound, over every visible point of the box, of the pixels that `error_m` can move it. Exact (largest at a corner)
/// where the box is within 35 degrees of the line of sight.
///
/// Why a corner: points that cost at most k are those with a distance from the line of sight of at most
/// h(z) = z sqrt(k^2 z^2 - 1). h is concave as long as k z, which is d/z there, is at most sqrt(3/2), and a set under a concave
/// curve, cut off by the cone d/z = sqrt(3/2), is convex: with its corners it holds the box.
///
/// @param box      holds a point both where it is and where it is shown, hence the way between
/// @param error_m  >= 0
/// @returns pixels, >= 0 and finite; whether anything of it is in view is not tested here (is_outside does)
/// Cost: about 30 ns.
inline double screen_error_px(const ViewMetric& metric, const EyeBox& box, double error_m) {
    constexpr double kCone_2 = 1.5;
    double front_m = -box[0].z, slant_2 = 1.0, worst_2 = 0.0;
    for (const glm::dvec3& corner : box) {
        const double per_depth_2 = 1.0 / (corner.z * corner.z);
        const double corner_slant_2 = glm::dot(corner, corner) * per_depth_2;
        front_m = std::min(front_m, -corner.z);
        slant_2 = std::max(slant_2, corner_slant_2);
        worst_2 = std::max(worst_2, corner_slant_2 * per_depth_2);
    }
    const bool is_ahead = front_m >= metric.near_m;
    if (is_ahead && slant_2 <= kCone_2) return metric.lambda_px * error_m * std::sqrt(worst_2);
    const double depth_m = std::max({front_m, distance_to_eye_m(box) / metric.stretch, metric.near_m});
    const double slant = is_ahead ? std::min(std::sqrt(slant_2), metric.stretch) : metric.stretch;
    return metric.lambda_px * error_m * slant / depth_m;
}

}  // namespace lod
