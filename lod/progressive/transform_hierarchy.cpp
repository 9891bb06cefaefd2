#include "lod/progressive/transform_hierarchy.h"

#include <algorithm>
#include <cmath>

#include "lod/body_pose.h"

namespace lod {
namespace {

/// The root of the largest row sum of M^T M: no smaller than M's largest stretch, and equal for a similarity.
double largest_stretch(const glm::dmat3& linear) {
    const glm::dmat3 squares = glm::transpose(linear) * linear;
    double most = 0.0;
    for (int column = 0; column < 3; ++column) {
        const glm::dvec3 sizes = glm::abs(squares[column]);
        most = std::max(most, sizes.x + sizes.y + sizes.z);
    }
    return std::sqrt(most) * (1.0 + 1e-6);
}

}  // namespace

void transform_hierarchy(VertexHierarchy& hierarchy, const glm::dmat4& to_from_mesh) {
    if (to_from_mesh == glm::dmat4(1.0)) return;
    const glm::dmat3 linear(to_from_mesh);
    const glm::dmat3 turn_normal = glm::transpose(glm::inverse(linear));
    const auto stretch = static_cast<float>(largest_stretch(linear));
    const bool keeps_cones = is_similarity(linear);
    const auto moved = [&](const glm::vec3& place) {
        return glm::vec3(glm::dvec3(to_from_mesh * glm::dvec4(glm::dvec3(place), 1.0)));
    };
    const auto turned = [&](const glm::vec3& normal) {
        return glm::vec3(glm::normalize(turn_normal * glm::dvec3(normal)));
    };
    for (NodeId node = 0; node < hierarchy.node_count(); ++node) {
        hierarchy.position[node] = moved(hierarchy.position[node]);
        hierarchy.centre[node] = moved(hierarchy.centre[node]);
        hierarchy.error_m[node] *= stretch;
        hierarchy.radius_m[node] *= stretch;
        if (keeps_cones) hierarchy.cone_axis[node] = turned(hierarchy.cone_axis[node]);
        if (!keeps_cones) hierarchy.cone_cos[node] = -1.0f;
    }
    for (glm::vec3& normal : hierarchy.normal)
        normal = turned(normal);
}

}  // namespace lod
