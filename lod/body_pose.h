// BodyPose: where a body is, and how it looks from there: instance records, spheres and views of bodies that move.
#pragma once

#include "lod/draw_list.h"
#include "lod/view.h"

namespace lod {

/// Where a body is.
struct BodyPose {
    enum class Frame : uint8_t {
        kWorld,   ///< vertices are world positions; the pose is ignored
        kPlaced,  ///< reference_from_body maps body to world
        kEye      ///< reference_from_body maps body to the eye frame: fixed in the cockpit
    };
    Frame frame = Frame::kWorld;
    glm::dmat3 reference_from_body{1.0};  ///< rotation times uniform scale
    glm::dvec3 origin{0.0};               ///< the body's origin in the reference frame, metres
};

/// Whether the matrix is a rotation times a uniform scale, to a relative 1e-6.
bool is_similarity(const glm::dmat3& matrix);

/// Whether the pose is one, and finite.
bool is_valid(const BodyPose& pose);

struct Sphere {
    glm::dvec3 centre{0.0};
    double radius_m = 0.0;
};

/// A sphere of the body's frame in the eye frame; only as good as the pose: rotation times uniform scale.
Sphere sphere_in_eye(const Sphere& body, const BodyPose& pose, const ViewMetric& metric);

/// The same view for somebody who lives in the body: its frame is the world, its unit the metre. Pixels stay.
View view_from_body(const View& view, const BodyPose& pose);

/// The record of one body in one view.
Instance make_body_instance(const View& view, const BodyPose& pose, Module module);

}  // namespace lod
