#include "sim/model_pose.h"

#include <cmath>
#include <numbers>

namespace sim {

namespace {

/// Counter-clockwise about +z, seen from +z.
glm::dmat3 turn_about_z(double angle_rad) {
    const double c = std::cos(angle_rad), s = std::sin(angle_rad);
    return glm::dmat3(glm::dvec3(c, s, 0.0), glm::dvec3(-s, c, 0.0), glm::dvec3(0.0, 0.0, 1.0));
}

}  // namespace

lod::BodyPose placed_pose(const data::WorldFrame& world, const data::SitePoint& site, double heading_rad,
                          double scale) {
    const glm::dvec3 origin = world.world_from_site(site);
    const double turn = std::numbers::pi - heading_rad;  // takes the front, -y, to north and then clockwise
    return {lod::BodyPose::Frame::kPlaced, world.world_from_enu(origin) * turn_about_z(turn) * scale, origin};
}

lod::BodyPose cockpit_pose(const glm::dvec3& position_eye_m, double heading_rad, double scale) {
    const glm::dmat3 eye_from_mesh(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0));
    return {lod::BodyPose::Frame::kEye, eye_from_mesh * turn_about_z(-heading_rad) * scale, position_eye_m};
}

lod::BodyPose carried_by(const lod::BodyPose& parent, const glm::dmat3& parent_from_body,
                         const glm::dvec3& origin_parent_m) {
    return {parent.frame, parent.reference_from_body * parent_from_body,
            parent.reference_from_body * origin_parent_m + parent.origin};
}

void move_bodies(std::span<const MovingBody> moving, const Signals& signals, std::span<lod::BodyPose> poses) {
    for (const MovingBody& part : moving) {
        const double value = signals.value[static_cast<size_t>(part.signal)];
        const double turns = std::remainder(value / part.units_per_turn, 1.0);
        const glm::dmat3 turned = part.parent_from_rest * turn_about_z(-2.0 * std::numbers::pi * turns);
        poses[part.body] = carried_by(poses[part.parent], turned, part.origin_parent_m);
    }
}

}  // namespace sim
