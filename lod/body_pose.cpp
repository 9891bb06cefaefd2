#include "lod/body_pose.h"

#include <algorithm>
#include <cmath>

namespace lod {

bool is_similarity(const glm::dmat3& matrix) {
    const double scale = glm::length(matrix[0]);
    if (!(scale > 0.0) || !std::isfinite(scale)) return false;
    const glm::dmat3 rest = glm::transpose(matrix) * matrix * (1.0 / (scale * scale)) - glm::dmat3(1.0);
    double worst = 0.0;
    for (int col = 0; col < 3; ++col)
        worst = std::max(worst, glm::length(rest[col]));
    return worst < 1e-6 && glm::determinant(matrix) > 0.0;
}

bool is_valid(const BodyPose& pose) {
    return pose.frame == BodyPose::Frame::kWorld ||
           (is_similarity(pose.reference_from_body) && std::isfinite(glm::dot(pose.origin, pose.origin)));
}

Sphere sphere_in_eye(const Sphere& body, const BodyPose& pose, const ViewMetric& metric) {
    if (pose.frame == BodyPose::Frame::kWorld) {
        return {metric.eye_from_world * (body.centre - metric.eye_world), body.radius_m};
    }
    const Sphere turned{pose.reference_from_body * body.centre,
                        body.radius_m * glm::length(pose.reference_from_body[0])};
    if (pose.frame == BodyPose::Frame::kEye) return {turned.centre + pose.origin, turned.radius_m};
    return {metric.eye_from_world * (turned.centre + (pose.origin - metric.eye_world)), turned.radius_m};
}

View view_from_body(const View& view, const BodyPose& pose) {
    if (pose.frame == BodyPose::Frame::kWorld) return view;
    const double scale = glm::length(pose.reference_from_body[0]);
    const glm::dmat3 rotation = pose.reference_from_body * (1.0 / scale);
    const bool is_in_cockpit = pose.frame == BodyPose::Frame::kEye;
    View seen = view;
    const glm::dvec3 way = (is_in_cockpit ? glm::dvec3(0.0) : view.eye_world) - pose.origin;
    seen.eye_world = glm::transpose(rotation) * way * (1.0 / scale);
    seen.eye_from_world = is_in_cockpit ? rotation : view.eye_from_world * rotation;
    seen.near_m = view.near_m / scale;
    return seen;
}

Instance make_body_instance(const View& view, const BodyPose& pose, Module module) {
    switch (pose.frame) {
        case BodyPose::Frame::kWorld:
            return make_world_instance(view.eye_world, view.eye_from_world, module);
        case BodyPose::Frame::kPlaced:
            return make_instance(view.eye_world, view.eye_from_world, pose.origin, pose.reference_from_body,
                                 module);
        case BodyPose::Frame::kEye:
            return make_instance(glm::dvec3(0.0), glm::dmat3(1.0), pose.origin, pose.reference_from_body,
                                 module);
    }
    return {};
}

}  // namespace lod
