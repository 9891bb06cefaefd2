// TriangleTree: a soup in a tree of boxes, asked how far away its surface is.
//
// The question that proofs need is `cover`: is there one triangle that all three corners of another are near to? The
// distance to a convex set is a convex function, so over a triangle it is largest at a corner: if the corners are
// within r of one triangle, so is everything between them.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "lod/surface/triangle.h"

namespace lod {

/// Which triangle, in the soup's order, and how far.
struct TriangleHit {
    uint32_t triangle = 0xffffffffu;
    double distance_m = std::numeric_limits<double>::infinity();
};

class TriangleTree {
  public:
    /// Cost: O(n log n), about 0.2 us a triangle and level of the tree. Deterministic.
    explicit TriangleTree(const Soup& soup);

    /// Nothing to be near to: no triangle, or none shown.
    bool is_empty() const { return nodes_.empty() || !nodes_[0].is_shown; }

    /// Hidden triangles are as if they were not there. All are shown at first.
    void hide_all();
    /// Cost: O(log n).
    void show(uint32_t triangle);

    /// The nearest triangle, if it is nearer than `limit_m`; else a hit without a triangle.
    TriangleHit nearest(const glm::dvec3& point,
                        double limit_m = std::numeric_limits<double>::infinity()) const;

    /// Any triangle at most `limit_m` from a point; a hit without a triangle if there is none.
    TriangleHit any_within(const glm::dvec3& point, double limit_m) const;

    /// The first triangle on a straight way, whichever side it shows, and how far from the beginning; both ends count.
    /// Rounding decides at edges and where the way lies in a triangle's plane.
    TriangleHit first_on_way(const glm::dvec3& from, const glm::dvec3& to) const;

    /// Whether there is one; cheaper than which.
    bool is_on_way(const glm::dvec3& from, const glm::dvec3& to) const;

    /// The triangle for which the largest of the corners' distances is least. Stops early at one where it is at
    /// most `enough_m`.
    /// @param hint  a triangle to try first, as an earlier answer gave it; any other number: none
    TriangleHit cover(const Triangle& corners, double enough_m, uint32_t hint) const;

    /// Any triangle that all corners are at most `limit_m` from; a hit without a triangle if there is none. Much
    /// cheaper than cover: nothing beyond the limit is visited.
    TriangleHit cover_within(const Triangle& corners, double limit_m, uint32_t hint) const;

  private:
    struct Node {
        glm::dvec3 low, high;
        uint32_t begin = 0, end = 0;  ///< of triangles_
        double longest_m = 0.0;       ///< edge of a triangle below
        uint32_t right = 0;           ///< second child, the first follows at once; 0: a leaf
        bool is_shown = true;         ///< something below is
    };
    struct Builder;

    /// @param enough  the first that is found within that share of the way will do
    TriangleHit on_way(const glm::dvec3& from, const glm::dvec3& to, double enough) const;
    TriangleHit cover_below(const Triangle& corners, double enough2, double below2, uint32_t hint) const;

    std::vector<Node> nodes_;
    std::vector<Triangle> triangles_;  ///< in the order of the leaves
    std::vector<uint32_t> original_;   ///< [triangles_] the soup's index
    std::vector<uint32_t> place_;      ///< [soup's index] where it lies
    std::vector<uint8_t> is_shown_;    ///< [triangles_]
};

}  // namespace lod
