// View: one eye, where it looks and what it can resolve; and ViewMetric, the numbers that LOD loops read.
//
// Frames: world is ECEF metres when the scene has a datum, else the source's own x, y and height (double). Eye
// frame: +x right, +y up, -z ahead. Everything here is a function of the view alone: no clock, no state.
#pragma once

#include <glm/glm.hpp>

namespace lod {

/// What one channel sees in one frame.
struct View {
    glm::dvec3 eye_world{0.0};            ///< metres
    glm::dmat3 eye_from_world{1.0};       ///< rotation, orthonormal, right-handed
    double fov_y_rad = 1.0;               ///< full vertical angle, in (0, pi)
    int width_px = 640, height_px = 360;  ///< both > 0
    double near_m = 0.1;                  ///< along -z; nothing nearer is drawn; no far limit
};

/// `View` prepared for loops; make it once per view and frame with `metric_of`.
struct ViewMetric {
    glm::dvec3 eye_world{0.0};
    glm::dmat3 eye_from_world{1.0};
    double lambda_px = 1.0;           ///< height_px / (2 tan(fov_y/2)): pixels per unit of lateral/depth
    double tan_x = 1.0, tan_y = 1.0;  ///< half extents of the picture at depth 1
    double cos_x = 1.0, cos_y = 1.0;  ///< 1/sqrt(1 + tan^2): turns a plane distance into metres
    double stretch = 1.0;             ///< sqrt(1 + tan_x^2 + tan_y^2): distance/depth in the picture's corner
    double near_m = 0.1;
};

ViewMetric metric_of(const View& view);

/// A view that looks from `eye` to `target`, horizon level where that is possible.
/// @param up_world  the local vertical; need not be normalised nor orthogonal to the line of sight
View look_at(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up_world, const View& optics);

/// The eye frame of a body at heading/pitch/roll in a local frame.
/// @param world_from_enu  columns east, north, up
/// @param heading_rad     clockwise from north; @param pitch_rad nose up; @param roll_rad right wing down
/// @returns eye_from_world
glm::dmat3 eye_from_attitude(const glm::dmat3& world_from_enu, double heading_rad, double pitch_rad,
                             double roll_rad);

}  // namespace lod
