// How far one surface is from another: bounds that hold for every point of every triangle, not for samples.
//
// A triangle of the first surface is within max(corners) of any one triangle of the second, because the distance to a
// convex set is convex. Where that is loose (no single triangle spans it) the triangle is bisected at its longest edge
// until the bound is tight enough: pieces of extent h leave a slack of at most h. Distances of corners are bounds from
// below. Nothing is sampled, nothing about topology assumed: borders, slivers, points and crossing sheets are all the
// same. Bounds hold to the rounding of doubles, some 1e-15 of the coordinates.
//
// Sources: Guthe, Borodin, Klein, Fast and accurate Hausdorff distance calculation between meshes (2005); the bound by
// single triangles follows from convexity (Boyd, Vandenberghe, Convex optimization, 3.2.5).
#pragma once

#include <vector>

#include "lod/surface/triangle_tree.h"

namespace lod {

/// The largest distance lies between the two, inclusive.
struct DistanceBounds {
    double lower_m = 0.0;
    double upper_m = 0.0;
};

/// The largest distance of a point of `from` to the surface `to`.
/// @param slack_m  > 0; upper - lower of the result is no larger. Cost rises as 1 / slack where the surfaces part
/// @returns        0 when `from` is empty, infinity when only `to` is. The same for any number of threads
DistanceBounds one_sided_distance(const Soup& from, const TriangleTree& to, double slack_m, unsigned threads);

/// The Hausdorff distance: the larger of both directions. Infinity when exactly one is empty.
DistanceBounds two_sided_distance(const Soup& a, const Soup& b, double slack_m, unsigned threads);

/// How long is_within may search, and where it begins.
struct PieceSearch {
    uint32_t most_pieces = 0xffffffffu;  ///< > 0; a triangle that needs more is refused
    double smallest_share = 1.0 / 64;    ///< of the limit; smaller pieces touch it, and are refused
    uint32_t hint =
        0xffffffffu;  ///< in and out: a triangle of the target that may be near; saves most of the search
                      ///< for a neighbour of the last
};

/// Whether a triangle is proved to lie within `limit_m` of `to`. One that touches the limit from below may be refused,
/// one beyond it always is.
bool is_within(const Triangle& triangle, const TriangleTree& to, double limit_m, PieceSearch& search);

/// Appends those triangles of `from`, in their order, for which is_within is false.
/// Cost: about 1 us a triangle where the surfaces are alike.
void find_beyond(const Soup& from, const TriangleTree& to, double limit_m, std::vector<uint32_t>& out,
                 PieceSearch search = {});

}  // namespace lod
