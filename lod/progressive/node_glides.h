// NodeGlides: vertices of one body on their way between the place they were born at and their own.
//
// A split leaves its two vertices where the node was shown and lets them glide to their places; a collapse waits until
// both have glided to the node's. Either way the surface is the same just before and just after the operation, so
// nothing jumps but by what a frame's share of a glide is. The way is a smooth function of time.
//
// Source: Hoppe (1997), geomorphs; in time as the terrain's (docs/decisions/0008-glide-in-time.md).
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

/// One vertex under way; displacements from its own place, mesh frame.
struct NodeGlide {
    NodeId node = kNoNode;
    bool leaves = false;  ///< towards its parent's place
    glm::vec3 from_m{0.0f}, to_m{0.0f};
    float way_m = 0.0f;  ///< length of the whole way, when it began
    double start_s = 0.0;
    glm::vec3 shown_m{0.0f};   ///< now
    glm::vec3 before_m{0.0f};  ///< in the frame before
    bool has_arrived() const { return shown_m == to_m; }
};

class NodeGlides {
  public:
    /// @param duration_s  of a whole glide; 0: nothing may ever start
    NodeGlides(uint32_t node_count, double duration_s);

    std::span<const NodeGlide> all() const { return glides_; }
    /// Null when the node does not glide.
    const NodeGlide* find(NodeId node) const;
    glm::vec3 displacement_m(NodeId node) const;

    /// A vertex that has just been born begins to glide home from `from_m`.
    void come(NodeId node, const glm::vec3& from_m, double now_s);
    /// A vertex begins to glide to `to_m`, from wherever it is.
    void leave(NodeId node, const glm::vec3& to_m, double now_s);
    /// It glides home again, from wherever it is; nothing when it does not glide.
    void turn_home(NodeId node, double now_s);
    /// The vertex is gone.
    void drop(NodeId node);
    void clear();

    /// Moves all to where they are at `now_s`. Those at home are dropped one frame later, so that their last step is
    /// drawn. Cost: about 10 ns a glide.
    void advance(double now_s);

  private:
    NodeGlide& make(NodeId node);
    glm::vec3 place_at(const NodeGlide& glide, double now_s) const;

    double duration_s_;
    std::vector<NodeGlide> glides_;
    std::vector<uint32_t> index_;  ///< [nodes] into glides_
};

}  // namespace lod
