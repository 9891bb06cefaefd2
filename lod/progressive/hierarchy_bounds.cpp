#include "lod/progressive/hierarchy_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lod/base/check.h"
#include "lod/progressive/collapse_step.h"

namespace lod {
namespace {

/// The least sphere around two.
GrowingSphere around(const GrowingSphere& a, const GrowingSphere& b) {
    if (a.radius < 0.0) return b;
    if (b.radius < 0.0) return a;
    const double apart = glm::length(b.centre - a.centre);
    if (apart + b.radius <= a.radius) return a;
    if (apart + a.radius <= b.radius) return b;
    const double radius = 0.5 * (apart + a.radius + b.radius);
    return {a.centre + (b.centre - a.centre) * ((radius - a.radius) / apart), radius};
}

/// A cone of directions: within the angle of an axis. Angles up to pi.
struct Cone {
    glm::dvec3 axis{0.0};
    double angle_rad = -1.0;  ///< below 0: nothing yet
};

constexpr double kPi = 3.14159265358979323846;

Cone around(const Cone& a, const Cone& b) {
    if (a.angle_rad < 0.0) return b;
    if (b.angle_rad < 0.0) return a;
    const double between = std::acos(std::clamp(glm::dot(a.axis, b.axis), -1.0, 1.0));
    if (between + b.angle_rad <= a.angle_rad) return a;
    if (between + a.angle_rad <= b.angle_rad) return b;
    const double angle = 0.5 * (between + a.angle_rad + b.angle_rad);
    const double turn = angle - a.angle_rad;
    const glm::dvec3 across = b.axis - a.axis * glm::dot(a.axis, b.axis);
    const double length = glm::length(across);
    if (angle >= kPi || length < 1e-9) return {a.axis, kPi};
    return {a.axis * std::cos(turn) + across * (std::sin(turn) / length), angle};
}

glm::dvec3 place(const VertexHierarchy& h, NodeId node) {
    return glm::dvec3(h.position[node]);
}

/// The full mesh's triangles: take(its corners, the leaf), for each leaf of each. @returns the nodes of all corners
template <typename Take>
std::vector<NodeId> replay_leaves(const VertexHierarchy& h, const Take& take) {
    std::vector<NodeId> corners;
    corners.reserve(3 * h.triangles.size());
    for (const auto& triangle : h.triangles) {
        corners.insert(corners.end(), triangle.begin(), triangle.end());
        for (NodeId leaf : triangle)
            take(triangle.data(), leaf);
    }
    return corners;
}

/// The k-th collapse: join(node, child) for both children, then take(its corners, the node) for all triangles it makes.
/// @param corners  as replay_leaves and the collapses before left them
template <typename Take, typename Join>
void replay_collapse(const VertexHierarchy& h, uint32_t k, std::vector<NodeId>& corners, const Take& take,
                     const Join& join) {
    const CollapseStep step = step_of(h, k);
    const NodeId node = h.leaf_count + k;
    for (NodeId child : step.children)
        join(node, child);
    for (CornerId corner : step.kept)
        corners[corner] = node;
    for (CornerId corner : step.kept)
        take(&corners[corner / 3 * 3], node);
}

}  // namespace

PlaceBounds::PlaceBounds(const VertexHierarchy& hierarchy)
    : hierarchy_(hierarchy), spheres_(hierarchy.node_count()) {
    corners_ = replay_leaves(hierarchy, [&](const NodeId* corners, NodeId leaf) { add(corners, leaf, 0.0); });
}

/// A triangle that the node is made with.
void PlaceBounds::add(const NodeId* corners, NodeId node, double error_m) {
    for (size_t k = 0; k < 3; ++k)
        spheres_[node] = around(spheres_[node], {place(hierarchy_, corners[k]), error_m});
}

void PlaceBounds::take(std::span<const float> errors_m) {
    for (float error_m : errors_m) {
        replay_collapse(
            hierarchy_, taken_++, corners_,
            [&](const NodeId* corners, NodeId node) { add(corners, node, double(error_m)); },
            [&](NodeId node, NodeId child) { spheres_[node] = around(spheres_[node], spheres_[child]); });
    }
}

void PlaceBounds::finish(VertexHierarchy& out) const {
    CHECK(taken_ == hierarchy_.collapse_count());
    out.centre.clear(), out.radius_m.clear();
    for (const GrowingSphere& sphere : spheres_) {
        const glm::vec3 centre(sphere.centre);
        const double shift = glm::length(glm::dvec3(centre) - sphere.centre);
        const auto radius = static_cast<float>(std::max(sphere.radius, 0.0) + shift);
        out.centre.push_back(centre);
        out.radius_m.push_back(radius * (1.0f + 4.0f * std::numeric_limits<float>::epsilon()) +
                               std::numeric_limits<float>::min());
    }
}

void bound_places(VertexHierarchy& h) {
    PlaceBounds bounds(h);
    bounds.take(std::span(h.error_m).subspan(h.leaf_count));
    bounds.finish(h);
}

void bound_normals(VertexHierarchy& h) {
    constexpr double kAngleSlack_rad = 1e-6;
    std::vector<Cone> cones(h.node_count());
    const auto take = [&](const NodeId* corners, NodeId node) {
        const glm::dvec3 a = place(h, corners[0]);
        const glm::dvec3 across = glm::cross(place(h, corners[1]) - a, place(h, corners[2]) - a);
        const double length = glm::length(across);
        if (length > 0.0) cones[node] = around(cones[node], {across / length, 0.0});
    };
    const auto join = [&](NodeId node, NodeId child) { cones[node] = around(cones[node], cones[child]); };
    std::vector<NodeId> corners = replay_leaves(h, take);
    for (uint32_t k = 0; k < h.collapse_count(); ++k)
        replay_collapse(h, k, corners, take, join);
    h.cone_axis.clear(), h.cone_cos.clear();
    for (const Cone& cone : cones) {
        const bool is_open = cone.angle_rad >= 0.0 && cone.angle_rad < 0.5 * kPi;
        h.cone_axis.push_back(cone.angle_rad < 0.0 ? glm::vec3(0.0f, 0.0f, 1.0f) : glm::vec3(cone.axis));
        h.cone_cos.push_back(is_open ? static_cast<float>(std::cos(cone.angle_rad + kAngleSlack_rad)) -
                                           std::numeric_limits<float>::epsilon()
                                     : -1.0f);
    }
}

}  // namespace lod
