// MeshCut: which nodes of a vertex hierarchy are active, and the triangles between them: vsplit, ecol, and whether
// they are legal.
//
//            a --- b        ecol ->          p
//          / | \ / | \    <- vsplit        / | \        star of p: what the build saw when it made p
//
// Legality is by identifiers alone (vertex_hierarchy.h): M(p), the largest id among p's neighbours, m(p), the smallest
// id among their parents. Both are read off the star when they are asked for: a star is some six triangles, and
// upkeep would touch as many nodes at every operation. Split p when p > M(p); collapse (a, b) -> p when p <= m(a), m(b).
//
// A triangle that a border collapse took away together with p's last edge to the collapse's node leaves no neighbour to
// ask; it stands for its remover, so M is never too small and a split never meets a star that the build did not see.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lod/progressive/mesh_tables.h"

namespace lod {

class MeshCut {
  public:
    /// Starts at the coarsest mesh. Keeps a reference.
    explicit MeshCut(const ProgressiveMesh& mesh);

    const ProgressiveMesh& mesh() const { return *mesh_; }
    bool is_active(NodeId node) const { return is_active_[node] != 0; }
    bool is_drawn(uint32_t triangle) const { return triangles_[triangle].corners[3] == 0; }
    /// Corners of a drawn triangle.
    std::span<const NodeId, 3> corners(uint32_t triangle) const {
        return std::span<const NodeId, 3>(triangles_[triangle].corners.data(), 3);
    }
    /// What those corners show.
    std::span<const VertexId, 3> vertices(uint32_t triangle) const {
        return std::span<const VertexId, 3>(triangles_[triangle].vertices);
    }
    uint32_t triangle_count() const { return drawn_count_; }
    /// Equal cuts have equal hashes.
    uint64_t hash() const { return hash_; }

    /// The active node that must be split before `node`; kNoNode: its split is legal now.
    /// @param node  active, no leaf
    NodeId split_blocker(NodeId node) const;
    /// The node that must be collapsed before `node`; kNoNode: its collapse is legal now.
    /// @param node  both children active
    NodeId collapse_blocker(NodeId node) const;
    bool are_children_active(NodeId node) const {
        const auto& children = mesh_->heads[mesh_->collapse_of(node)].children;
        return is_active(children[0]) && is_active(children[1]);
    }

    /// Calls up the memory that an operation on the node will read soon. Changes nothing.
    void expect_vsplit(NodeId node) const;
    void expect_ecol(NodeId node) const;

    /// The operations; DCHECK that they are legal. Never allocate.
    void vsplit(NodeId node);
    void ecol(NodeId node);

    /// Triangles whose corners changed, or that came or went, since the last call of forget_touched(); each once.
    std::span<const uint32_t> touched() const { return touched_; }
    void forget_touched();

    /// Proves every invariant from the full mesh; empty, or one line. Slow.
    std::string validate() const;

  private:
    static constexpr NodeId kNoParent = 0x7fffffffu;  ///< younger than any node, also as a signed number
    using Four = std::array<NodeId, 4>;

    /// All that an operation reads and writes of a triangle, on one line of the cache: a star's triangles lie anywhere. A
    /// star is read four numbers at a time, without asking which triangles are drawn.
    struct alignas(64) Triangle {
        Four corners{};  ///< of one not drawn: when it last was; the fourth: whether it is not drawn
        Four parents{};  ///< of the corners; the fourth: kNoParent
        std::array<VertexId, 3> vertices{};
        uint32_t is_touched = 0;
    };
    static_assert(sizeof(Triangle) == 64);

    NodeId parent_of(NodeId node) const { return std::min(mesh_->hierarchy.parent[node], kNoParent); }

    void show(CornerId corner, NodeId node, NodeId parent, VertexId vertex) {
        Triangle& triangle = triangles_[corner / 3];
        triangle.corners[corner % 3] = node;
        triangle.parents[corner % 3] = parent;
        triangle.vertices[corner % 3] = vertex;
        touch(corner / 3);
    }
    NodeId split_blocker_of_torn(NodeId node) const;
    void touch(uint32_t triangle) {
        if (triangles_[triangle].is_touched != 0) return;
        triangles_[triangle].is_touched = 1;
        touched_.push_back(triangle);
    }

    const ProgressiveMesh* mesh_;
    std::vector<Triangle> triangles_;
    std::vector<uint8_t> is_active_;  ///< [nodes]
    std::vector<uint32_t> touched_;
    uint32_t drawn_count_ = 0;
    uint64_t hash_ = 0;
};

}  // namespace lod
