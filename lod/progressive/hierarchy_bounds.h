// Spheres and cones of a vertex hierarchy's nodes. They hold after rounding to float.
#pragma once

#include <span>
#include <vector>

#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

/// A sphere that grows. Mesh frame, metres.
struct GrowingSphere {
    glm::dvec3 centre{0.0};
    double radius = -1.0;  ///< below 0: nothing yet
};

/// Spheres of nodes, from the leaves up, while errors are still being proved.
class PlaceBounds {
  public:
    /// @param hierarchy  whole but for its errors; kept by reference, must not change
    explicit PlaceBounds(const VertexHierarchy& hierarchy);

    /// Takes the errors of the next collapses' nodes, in their order. Leaves have none.
    void take(std::span<const float> errors_m);
    /// Fills centre and radius_m, once all errors are there.
    void finish(VertexHierarchy& out) const;

  private:
    void add(const NodeId* corners, NodeId node, double error_m);

    const VertexHierarchy& hierarchy_;
    std::vector<NodeId> corners_;  ///< nodes of the triangles as far as collapses are taken
    std::vector<GrowingSphere> spheres_;
    uint32_t taken_ = 0;  ///< collapses
};

/// Fills centre and radius_m from geometry and error_m: a point of the full mesh that a triangle stands for is within
/// error_m of it, so a sphere takes in its triangles plus their error.
void bound_places(VertexHierarchy& hierarchy);

/// Fills cone_axis and cone_cos from geometry alone.
void bound_normals(VertexHierarchy& hierarchy);

}  // namespace lod
