// The one screen-error metric: how many pixels an object-space error can cost, as a bound that holds.
//
// A displacement of e metres at a point at depth z (along the line of sight) and distance d moves its image by
// at most  lambda * e / z * (d / z)  pixels: one division for the perspective, and the picture plane is slanted
// by d/z towards the corners. The usual e*lambda/d is not a bound there. With the error inside a sphere, z is
// taken at its nearest visible point and d/z at its most slanted one.
#pragma once

#include <algorithm>
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

}  // namespace lod
