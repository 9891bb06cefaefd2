#include "sim/model_bodies.h"

#include <charconv>
#include <cmath>
#include <optional>

namespace sim {
namespace {

std::optional<double> units_per_turn(const std::string& name) {
    const size_t mark = name.rfind('_');
    if (mark == std::string::npos) return std::nullopt;
    double units = 0.0;
    const char *begin = name.data() + mark + 1, *end = name.data() + name.size();
    const auto [stop, error] = std::from_chars(begin, end, units);
    if (error != std::errc() || stop != end || !std::isfinite(units) || units == 0.0) return std::nullopt;
    return units;
}

/// The rigid frame at a node: its origin, its z axis, and x and y made square to it.
glm::dmat4 rigid_frame(const glm::dmat4& node) {
    const glm::dvec3 z = glm::normalize(glm::dvec3(node[2]));
    const glm::dvec3 across(node[0]);
    const glm::dvec3 x = glm::normalize(across - z * glm::dot(across, z));
    return {glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0), glm::dvec4(z, 0.0), node[3]};
}

const Drive* drive_of(const std::string& node, std::span<const Drive> drives) {
    for (const Drive& drive : drives) {
        if (drive.node == node) return &drive;
    }
    return nullptr;
}

/// Gives the node a body of its own when a drive names it, else its parent's.
void assign_body(const ModelNode& node, const Drive* drive, ModelBodies& out) {
    const bool is_root = node.parent < 0;
    const size_t parent = is_root ? 0 : static_cast<size_t>(node.parent);
    const uint32_t carrier = is_root ? 0 : out.body_of_node[parent];
    const glm::dmat4 carrier_from_node =
        (is_root ? glm::dmat4(1.0) : out.body_from_node[parent]) * node.parent_from_node;
    if (drive == nullptr) {
        out.body_of_node.push_back(carrier);
        out.body_from_node.push_back(carrier_from_node);
        return;
    }
    const glm::dmat4 frame = rigid_frame(carrier_from_node);
    MovingBody moving{.body = static_cast<uint32_t>(out.bodies.size()), .parent = carrier};
    moving.parent_from_rest = glm::dmat3(frame);
    moving.origin_parent_m = glm::dvec3(frame[3]);
    moving.signal = drive->signal;
    moving.units_per_turn = *units_per_turn(node.name);
    out.bodies.push_back(carried_by(out.bodies[carrier], moving.parent_from_rest, moving.origin_parent_m));
    out.moving.push_back(moving);
    out.body_of_node.push_back(moving.body);
    out.body_from_node.push_back(glm::inverse(frame) * carrier_from_node);
}

}  // namespace

lod::Result<ModelBodies> make_model_bodies(std::span<const ModelNode> nodes, const lod::BodyPose& placement,
                                           std::span<const Drive> drives) {
    ModelBodies model;
    model.bodies.push_back(placement);
    for (const Drive& drive : drives) {
        if (!units_per_turn(drive.node)) {
            return lod::Error{"drive " + drive.node +
                              ": expected a name that ends in _ and its units per turn"};
        }
        bool is_found = false;
        for (const ModelNode& node : nodes)
            is_found |= node.name == drive.node;
        if (!is_found) return lod::Error{"drive " + drive.node + ": the model has no node of that name"};
    }
    for (const ModelNode& node : nodes)
        assign_body(node, drive_of(node.name, drives), model);
    return model;
}

}  // namespace sim
