// VertexHierarchy: every state an edge-collapse sequence can pass through, as static arrays that any number of
// fronts share.
//
// Leaves are the vertices of the full mesh, 0 … leaf_count - 1; the k-th collapse (a, b) -> p makes node
// p = leaf_count + k. A node lives from its own id until its parent's: edges join nodes whose lives overlap.
//
// Collapse (a, b) -> p is legal when id(p) < oldest parent id of the neighbours of a and b; split p when id(p) > the
// largest id among p's neighbours. Then every front is made of triangles of the build sequence, and the star around a
// split or a collapse is exactly the one the build saw: any two ends of an edge were alive at one moment, so
// were any three corners (intervals that meet in pairs have a common point). That is why two integers replace
// dependency lists, and why an error proved in the build holds in every front.
//
// What is drawn are vertices: a place, a normal and a colour. Vertex n is node n's own; where normals or colours
// break (creases, borders of materials) a node has further vertices, with ids from node_count() up. A triangle's
// corner shows one vertex; an operation that changes the corner's node changes its vertex as kept_vertex says.
//
// Sources: El-Sana, Varshney, Generalized view-dependent simplification (1999); Kalachev, Reshetnikova (see
// docs), sections on PAT and CAT lists and identifiers; Hoppe, View-dependent refinement (1997).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace lod {

using NodeId = uint32_t;
inline constexpr NodeId kNoNode = 0xffffffffu;

/// A drawn vertex: an index into normal, colour and vertex_node.
using VertexId = uint32_t;

/// A corner of a triangle: three times the triangle plus 0, 1 or 2.
using CornerId = uint32_t;

/// The other two corners of a corner's triangle, counter-clockwise.
inline CornerId next_corner(CornerId corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}
inline CornerId prev_corner(CornerId corner) {
    return corner % 3 == 0 ? corner + 2 : corner - 1;
}

/// Geometry is in the mesh frame, metres. Arrays are [nodes] unless said otherwise; what belongs to collapses is
/// [collapses], node leaf_count + k at k.
struct VertexHierarchy {
    uint32_t leaf_count = 0;

    std::vector<glm::vec3> position;
    std::vector<NodeId> parent;                   ///< kNoNode: a root
    std::vector<std::array<NodeId, 2>> children;  ///< [collapses]: a (which keeps its place first) and b

    std::vector<std::array<NodeId, 3>> triangles;  ///< of the full mesh: leaves, counter-clockwise

    // Drawn vertices: [vertices]; vertex n has the place of node n for n < node_count().
    std::vector<NodeId> vertex_node;
    std::vector<glm::vec3> normal;                           ///< unit length
    std::vector<glm::u8vec4> colour;                         ///< sRGB; alpha: lod::Material
    std::vector<std::array<VertexId, 3>> triangle_vertices;  ///< [triangles] of the full mesh

    // The static star of each collapse (a, b) -> p.
    std::vector<uint32_t> removed_begin;  ///< [collapses + 1] into removed: PAT
    std::vector<uint32_t> removed;        ///< triangles that hold both a and b
    std::vector<uint32_t> kept_begin;  ///< [2 * collapses + 1] into kept: corners of a, then those of b: CAT
    std::vector<CornerId> kept;        ///< corners that are a (or b) before the collapse and p after
    std::vector<std::array<VertexId, 2>> kept_vertex;  ///< [kept]: the corner's vertex before and after

    // What a front decides by.

    /// Proved: the triangles that the node's collapse made depart from the full mesh by no more, both ways. Every
    /// triangle of a front was made by its youngest corner, so a front departs by no more than the largest of its
    /// active nodes. Leaves 0; rises to the root.
    std::vector<float> error_m;

    /// Sphere that holds those triangles, the full triangles they stand for (a leaf's: the full triangles around
    /// it) and the spheres of the children.
    std::vector<glm::vec3> centre;
    std::vector<float> radius_m;

    /// Normals of all those triangles are within an angle of this axis.
    std::vector<glm::vec3> cone_axis;
    std::vector<float> cone_cos;  ///< cosine of that angle; -1: no cone

    uint32_t node_count() const { return static_cast<uint32_t>(position.size()); }
    uint32_t collapse_count() const { return node_count() - leaf_count; }
    uint32_t vertex_count() const { return static_cast<uint32_t>(vertex_node.size()); }
};

}  // namespace lod
