#include "lod/view.h"

#include <cmath>

namespace lod {

ViewMetric metric_of(const View& view) {
    ViewMetric metric;
    metric.eye_world = view.eye_world;
    metric.eye_from_world = view.eye_from_world;
    metric.tan_y = std::tan(view.fov_y_rad / 2.0);
    metric.tan_x = metric.tan_y * view.width_px / view.height_px;
    metric.lambda_px = view.height_px / (2.0 * metric.tan_y);
    metric.cos_x = 1.0 / std::sqrt(1.0 + metric.tan_x * metric.tan_x);
    metric.cos_y = 1.0 / std::sqrt(1.0 + metric.tan_y * metric.tan_y);
    metric.stretch = std::sqrt(1.0 + metric.tan_x * metric.tan_x + metric.tan_y * metric.tan_y);
    metric.near_m = view.near_m;
    return metric;
}

View look_at(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up_world,
             const View& optics) {
    const glm::dvec3 back = glm::normalize(eye - target);
    glm::dvec3 right = glm::cross(up_world, back);
    if (glm::length(right) < 1e-9 * glm::length(up_world)) {  // straight up or down: any level axis will do
        const glm::dvec3 other = std::abs(back.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        right = glm::cross(other, back);
    }
    right = glm::normalize(right);
    View view = optics;
    view.eye_world = eye;
    view.eye_from_world = glm::transpose(glm::dmat3(right, glm::cross(back, right), back));
    return view;
}

glm::dmat3 eye_from_attitude(const glm::dmat3& world_from_enu, double heading_rad, double pitch_rad,
                             double roll_rad) {
    const double sh = std::sin(heading_rad), ch = std::cos(heading_rad);
    const double sp = std::sin(pitch_rad), cp = std::cos(pitch_rad);
    const double sr = std::sin(roll_rad), cr = std::cos(roll_rad);
    const glm::dvec3 ahead(sh * cp, ch * cp, sp);
    const glm::dvec3 level_right(ch, -sh, 0.0);
    const glm::dvec3 level_up = glm::cross(level_right, ahead);
    const glm::dvec3 right = level_right * cr - level_up * sr;
    const glm::dvec3 up = level_up * cr + level_right * sr;
    const glm::dmat3 enu_from_eye(right, up, -ahead);
    return glm::transpose(world_from_enu * enu_from_eye);
}

}  // namespace lod
