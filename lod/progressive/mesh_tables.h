// MeshTables: what fronts derive once from a vertex hierarchy and share: every vertex's star at its birth, and
// each triangle's end.
//
// While a node lives, its star only loses triangles (to collapses that the build made later), so the corners it was
// born with are all that a walk around it has to look at.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

/// What a front ranks a collapse's node by, side by side; 36 bytes. Mesh frame, metres.
struct NodeBound {
    glm::vec3 centre{0.0f};
    float radius_m = 0.0f;  ///< rounded up
    float error_m = 0.0f;   ///< proved, and more where it is seen more (part_breadth.h)
    glm::vec3 cone_axis{0.0f};
    float cone_cos = -1.0f;  ///< -1: no cone
};

/// What an operation reads of a collapse first, before its lists; 32 bytes.
struct CollapseHead {
    std::array<NodeId, 2> children{};
    NodeId parent = kNoNode;               ///< of its node
    uint32_t begin = 0;                    ///< of its lists in `lists`
    std::array<uint32_t, 2> kept_count{};  ///< corners of its children
    uint32_t removed_count = 0;            ///< triangles
    float way_m = 0.0f;                    ///< of its farther child to its place
};
static_assert(sizeof(CollapseHead) == 32);

/// A hierarchy and its tables; never changes while a front looks at it.
struct ProgressiveMesh {
    VertexHierarchy hierarchy;  ///< without kept, kept_vertex and removed: `lists` holds them
    bool is_glass = false;      ///< all of it, or none

    std::vector<std::array<NodeId, 3>>
        last_corners;  ///< [triangles] before its removal, or of the coarsest mesh
    std::vector<std::array<VertexId, 3>> last_vertices;  ///< ... and what its corners show then
    std::vector<NodeId> remover;             ///< [triangles] node whose collapse removes it; kNoNode: none
    std::vector<uint32_t> further_begin;     ///< [nodes + 1] into further_vertices
    std::vector<VertexId> further_vertices;  ///< what a node shows beside the vertex with its own id
    std::vector<NodeBound> bounds;           ///< [collapses]
    std::vector<CollapseHead> heads;         ///< [collapses]
    std::vector<uint32_t> lists;             ///< of each collapse, side by side: kept, removed, kept_vertices
    std::vector<uint32_t> leaf_begin;        ///< [leaves + 1] into leaf_corners
    std::vector<CornerId> leaf_corners;      ///< of the full mesh, by their leaf
    std::vector<NodeId> roots;               ///< nodes without parent, rising
    glm::dvec3 centre{0.0};                  ///< sphere around every node's position
    double radius_m = 0.0;

    uint32_t triangle_count() const { return static_cast<uint32_t>(hierarchy.triangles.size()); }
    uint32_t leaf_count() const { return hierarchy.leaf_count; }
    bool is_leaf(NodeId node) const { return node < hierarchy.leaf_count; }
    uint32_t collapse_of(NodeId node) const { return node - hierarchy.leaf_count; }

    /// Triangles that hold both children of a collapse: PAT.
    std::span<const uint32_t> removed(uint32_t collapse) const {
        const CollapseHead& head = heads[collapse];
        return {lists.data() + head.begin + head.kept_count[0] + head.kept_count[1], head.removed_count};
    }
    /// Corners that a collapse hands from one of its children to its node: half a CAT.
    std::span<const CornerId> kept(uint32_t collapse, uint32_t child) const {
        const CollapseHead& head = heads[collapse];
        return {lists.data() + head.begin + (child == 0 ? 0 : head.kept_count[0]), head.kept_count[child]};
    }
    /// What its kept corners show, those of both children in turn: two numbers each, before the collapse and after.
    const VertexId* kept_vertices(uint32_t collapse) const {
        const CollapseHead& head = heads[collapse];
        return lists.data() + head.begin + head.kept_count[0] + head.kept_count[1] + head.removed_count;
    }
    /// What a node shows beside the vertex with its own id.
    std::span<const VertexId> further(NodeId node) const {
        return {further_vertices.data() + further_begin[node], further_begin[node + 1] - further_begin[node]};
    }
    /// The corners a node is born with, which must not be a leaf.
    std::span<const CornerId> star(NodeId node) const {
        const CollapseHead& head = heads[collapse_of(node)];
        return {lists.data() + head.begin, head.kept_count[0] + head.kept_count[1]};
    }
    /// The corners a leaf has in the full mesh.
    std::span<const CornerId> full_star(NodeId leaf) const {
        return {leaf_corners.data() + leaf_begin[leaf], leaf_begin[leaf + 1] - leaf_begin[leaf]};
    }
};

/// Derives the tables. The hierarchy must be one that fault_of() finds nothing wrong with (hierarchy_check.h).
/// Cost: one replay of the collapses.
ProgressiveMesh make_progressive_mesh(VertexHierarchy hierarchy, bool is_glass = false);

}  // namespace lod
