#include "lod/progressive/hierarchy_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lod {
namespace {

struct Sphere {
    glm::dvec3 centre{0.0};
    double radius = -1.0;  ///< below 0: nothing yet
};

/// The least sphere around two.
Sphere around(const Sphere& a, const Sphere& b) {
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

/// What is gathered for the nodes, in double until all is known.
struct Bounds {
    std::vector<Sphere> spheres;
    std::vector<Cone> cones;
};

/// Takes a triangle, given by nodes, into a node's bounds.
void take_triangle(const VertexHierarchy& h, const NodeId* corners, NodeId node, Bounds& bounds) {
    const glm::dvec3 a(h.position[corners[0]]), b(h.position[corners[1]]), c(h.position[corners[2]]);
    const double slack = h.error_m.empty() ? 0.0 : double(h.error_m[node]);
    Sphere& sphere = bounds.spheres[node];
    for (const glm::dvec3& p : {a, b, c})
        sphere = around(sphere, {p, slack});
    const glm::dvec3 across = glm::cross(b - a, c - a);
    const double length = glm::length(across);
    if (length > 0.0) bounds.cones[node] = around(bounds.cones[node], {across / length, 0.0});
}

void round_outwards(VertexHierarchy& h, const Bounds& bounds) {
    constexpr double kAngleSlack_rad = 1e-6;
    for (size_t node = 0; node < h.node_count(); ++node) {
        const Sphere& sphere = bounds.spheres[node];
        const Cone& cone = bounds.cones[node];
        const glm::vec3 centre(sphere.centre);
        const double shift = glm::length(glm::dvec3(centre) - sphere.centre);
        const auto radius = static_cast<float>(std::max(sphere.radius, 0.0) + shift);
        h.centre.push_back(centre);
        h.radius_m.push_back(radius * (1.0f + 4.0f * std::numeric_limits<float>::epsilon()) +
                             std::numeric_limits<float>::min());
        const bool is_open = cone.angle_rad >= 0.0 && cone.angle_rad < 0.5 * kPi;
        h.cone_axis.push_back(cone.angle_rad < 0.0 ? glm::vec3(0.0f, 0.0f, 1.0f) : glm::vec3(cone.axis));
        h.cone_cos.push_back(is_open ? static_cast<float>(std::cos(cone.angle_rad + kAngleSlack_rad)) -
                                           std::numeric_limits<float>::epsilon()
                                     : -1.0f);
    }
}

}  // namespace

void bound_nodes(VertexHierarchy& h) {
    Bounds bounds{std::vector<Sphere>(h.node_count()), std::vector<Cone>(h.node_count())};
    std::vector<NodeId> corners;
    corners.reserve(3 * h.triangles.size());
    for (const auto& triangle : h.triangles) {
        corners.insert(corners.end(), triangle.begin(), triangle.end());
        for (NodeId leaf : triangle)
            take_triangle(h, triangle.data(), leaf, bounds);
    }
    for (uint32_t k = 0; k < h.collapse_count(); ++k) {
        const NodeId node = h.leaf_count + k;
        for (NodeId child : h.children[k]) {
            bounds.spheres[node] = around(bounds.spheres[node], bounds.spheres[child]);
            bounds.cones[node] = around(bounds.cones[node], bounds.cones[child]);
        }
        for (uint32_t i = h.kept_begin[2 * k]; i < h.kept_begin[2 * k + 2]; ++i)
            corners[h.kept[i]] = node;
        for (uint32_t i = h.kept_begin[2 * k]; i < h.kept_begin[2 * k + 2]; ++i)
            take_triangle(h, &corners[h.kept[i] / 3 * 3], node, bounds);
    }
    h.centre.clear(), h.radius_m.clear(), h.cone_axis.clear(), h.cone_cos.clear();
    round_outwards(h, bounds);
}

}  // namespace lod
