// Where a place in the world is in a picture: written out by hand, shares no code with lod/.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "lod/view.h"

namespace terrain_test {

inline double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

/// Pixels from the picture's centre; z: depth in metres.
inline glm::dvec3 projected(const lod::View& view, const glm::dvec3& world) {
    const glm::dvec3 eye = view.eye_from_world * (world - view.eye_world);
    const double scale = view.height_px / (2.0 * std::tan(view.fov_y_rad / 2.0)) / -eye.z;
    return {eye.x * scale, eye.y * scale, -eye.z};
}

inline bool is_in_picture(const lod::View& view, const glm::dvec3& picture) {
    return picture.z > view.near_m && std::abs(picture.x) < view.width_px / 2.0 &&
           std::abs(picture.y) < view.height_px / 2.0;
}

}  // namespace terrain_test
