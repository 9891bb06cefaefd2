// Poses of models: where one stands or hangs, and how signals turn its needles and drums.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "data/world_frame.h"
#include "lod/rigid_front.h"
#include "sim/signals.h"

namespace sim {

/// A body of a model that turns about its own +z axis: clockwise for a viewer on that axis who looks back at
/// it, one turn per `units_per_turn` of its signal. Negative units turn counter-clockwise (a compass card).
struct MovingBody {
    uint32_t body = 0;                 ///< into the model's bodies
    uint32_t parent = 0;               ///< a body that comes earlier; its motion carries this one
    glm::dmat3 parent_from_rest{1.0};  ///< rotation at signal 0
    glm::dvec3 origin_parent_m{0.0};   ///< in the parent's frame
    int signal = 0;                    ///< into Signals::value
    double units_per_turn = 1.0;       ///< not zero
};

/// A model that stands at a site: mesh frame +z up, its front (-y) facing `heading_rad`, clockwise from north.
/// @param scale  > 0
lod::BodyPose placed_pose(const data::WorldFrame& world, const data::SitePoint& site, double heading_rad,
                          double scale);

/// A model fixed in the cockpit: its front (-y) faces the eye, its +z is up; (x, y, z) becomes (x, z, -y).
/// @param position_eye_m  of the mesh's origin, eye frame
/// @param heading_rad     turns it about its vertical, clockwise from above
lod::BodyPose cockpit_pose(const glm::dvec3& position_eye_m, double heading_rad, double scale);

/// The pose of a body whose frame lies in another body's frame.
/// @param parent_from_body  rotation
lod::BodyPose carried_by(const lod::BodyPose& parent, const glm::dmat3& parent_from_body,
                         const glm::dvec3& origin_parent_m);

/// Turns every moving body to its signal. Allocates nothing.
/// @param moving  parents before children
/// @param poses   [bodies of the model]; entries of moving bodies are overwritten
void move_bodies(std::span<const MovingBody> moving, const Signals& signals, std::span<lod::BodyPose> poses);

}  // namespace sim
