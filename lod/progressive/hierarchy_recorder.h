// HierarchyRecorder: writes a VertexHierarchy down while edges collapse, with the vertices that corners show.
#pragma once

#include <span>
#include <vector>

#include "lod/progressive/collapse_step.h"
#include "lod/progressive/manifold_mesh.h"
#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

/// A collapse as the half-edges see it, before it happens.
struct EdgeCollapse {
    NodeId a = 0, b = 0;
    glm::vec3 position{0.0f};  ///< of the new node
    float share = 0.0f;        ///< how much of b's looks the new node takes, the rest is a's; [0, 1]
    std::span<const uint32_t> a_triangles;  ///< all triangles around a
    std::span<const uint32_t> b_triangles;
};

class HierarchyRecorder {
  public:
    explicit HierarchyRecorder(const ManifoldMesh& mesh);

    /// Appends a node and returns its id; corners of a and b are the new node's from now on.
    /// Vertices of a and b that meet in a removed triangle become one, with mixed normal and colour; others live on.
    NodeId record(const EdgeCollapse& collapse);

    /// What the last record() was; holds until the next.
    CollapseStep last_step() const { return step_of(out_, out_.collapse_count() - 1); }

    /// The hierarchy, still without errors, spheres and cones.
    VertexHierarchy finish();

  private:
    void record_corners(NodeId node, std::span<const uint32_t> triangles, bool is_first);
    void join_removed(const EdgeCollapse& collapse);
    void show_vertices(NodeId node, const EdgeCollapse& collapse);
    size_t group_of(VertexId vertex);
    VertexId mix(std::span<const VertexId> group, NodeId node, const EdgeCollapse& collapse);

    VertexHierarchy out_;
    std::vector<NodeId> corner_node_;
    std::vector<VertexId> corner_vertex_;
    // Vertices behind the nodes' own, numbered from kFurther until the number of nodes is known.
    std::vector<NodeId> further_node_;
    std::vector<glm::vec3> further_normal_;
    std::vector<glm::u8vec4> further_colour_;
    std::vector<std::vector<VertexId>> groups_;  // scratch of one collapse: vertices that become one
};

}  // namespace lod
