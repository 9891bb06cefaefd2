// Outline: a convex polygon in a plane, and how few corners come near it.
//
//        ___            a ring of n corners whose corners stick out as far as its sides cut in
//      /     \          comes nearest to something round; the rectangle of least area to
//     |   +   |         something with four sides
//      \ ___ /
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace objects {

using Outline = std::vector<glm::dvec2>;  ///< corners in the order of the angle; two: a segment; one: a point

/// The convex hull, no corner on the line between its neighbours. Source: Andrew's monotone chain (1979).
Outline convex_outline(std::span<const glm::dvec2> points);

/// The rectangle of least area that holds an outline, one side along a side of it: four corners, or fewer when some
/// coincide.
Outline least_rectangle(const Outline& outline);

/// A regular polygon about the middle of an outline's rectangle whose corners are as far outside a circle of the
/// outline's mean radius as its sides are inside.
/// @param corners  >= 3
Outline balanced_ring(const Outline& outline, const Outline& rectangle, uint32_t corners);

/// The largest distance of a corner of either to the other: a guess at how far apart the two are, and not more.
double corner_distance(const Outline& a, const Outline& b);

}  // namespace objects
