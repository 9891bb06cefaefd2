// Fit: a few triangles moved until a surface is within a limit of them, and they of it.
//
//          * .                      *  a point of the surface that is too far pulls the nearest triangle's corners,
//            |  .                      each by its share in the nearest point;
//       +----o----------+           o  a point of a triangle that is too far from the surface is pulled back the
//        \          +                  same way
//
// Each pull is the least move that satisfies one of the conditions; taking them in turns comes to a place that satisfies all,
// where there is one near by, and stays near where it began. Source: Bregman, The method of successive projection for
// finding a common point of convex sets (1965); Kaczmarz's for linear ones. The conditions here are not convex, so it is a
// guess as all proposals are, and what it looks at are samples: who uses the triangles proves them.
#pragma once

#include <span>

#include "lod/surface/triangle_tree.h"

namespace objects {

/// All in one frame, metres.
struct FitTarget {
    std::span<const glm::dvec3> points;  ///< of the surface, that should come within the limit of a triangle
    lod::Soup surface;                   ///< what triangles should stay near …
    const lod::TriangleTree* tree;       ///< … in a tree, not null; empty: nothing fits
};

/// @param limit_m    > 0
/// @param triangles  in and out, at least one; collapsed ones are welcome. Anything when it returns false
/// @returns          whether all samples are within the limit at last
/// Cost: some 10 to 100 us a triangle. Deterministic.
bool fit(const FitTarget& target, double limit_m, std::span<lod::Triangle> triangles);

}  // namespace objects
