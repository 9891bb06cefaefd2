// CoarseMesh: the half-edges of a vertex hierarchy's mesh while its collapses are replayed.
//
//            r            A corner is also the half-edge that leaves it: corner c of triangle t runs from its node to
//           / \           that of next(c), t on its left. `mate` is the same edge in the neighbour, kNoCorner at a
//     prev /   \ next     border. Triangles keep their numbers for life.
//         p --- q
//          corner
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

inline constexpr CornerId kNoCorner = 0xffffffffu;

/// The corners of one node, counter-clockwise. Open at a border: then the first one's half-edge is the border.
struct Fan {
    std::vector<CornerId> corners;
    bool is_closed = false;
};

class CoarseMesh {
  public:
    /// The full mesh. CHECKs that it is a manifold.
    CoarseMesh(std::span<const std::array<NodeId, 3>> triangles, uint32_t leaf_count);

    NodeId node(CornerId corner) const { return node_[corner]; }
    NodeId head(CornerId corner) const { return node_[next_corner(corner)]; }
    CornerId mate(CornerId corner) const { return mate_[corner]; }
    size_t corner_count() const { return node_.size(); }

    /// The corners around the node at `corner`, which comes first when the fan is closed.
    void fan_at(CornerId corner, Fan& out) const;

    /// Takes a triangle out: the two edges that its half-edges `one` and `other` lie on become one, or a border.
    void close_gap(CornerId one, CornerId other);
    void set_node(CornerId corner, NodeId node) { node_[corner] = node; }

  private:
    std::vector<NodeId> node_;    // [corners]
    std::vector<CornerId> mate_;  // [corners]
};

}  // namespace lod
