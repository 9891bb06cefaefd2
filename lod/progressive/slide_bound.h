// SlideBound: how far a surface is off while one of its vertices is not at its place: less than the vertex is, as most of
// its way lies in the surface. A vertex that slides along the edge of a bezel changes nothing.
//
// Seen along some axis both stars, around the place and around where the vertex is shown, lie side by side over one
// polygon. There their gap is largest where the shown vertex faces a plane of the star around the place:
//
//     gap <= max over faces |n . (shown - place)| / (n . axis)
//
// Along an outer edge's end, from the shown vertex to a corner of the polygon, the gap to the face that holds the corner
// falls from no more than that to 0; the face before it falls from no more to what the first had at their edge, and so
// on; and the gap of two surfaces of planes is largest where edges meet. A star at a border has the polygon's border
// made straight first, which costs both vertices' distances from it.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

/// The edge of a triangle that is opposite to a vertex, as the triangle runs.
struct OuterEdge {
    NodeId from = kNoNode, to = kNoNode;
    glm::dvec3 from_m{0.0}, to_m{0.0};
};

/// @param star  all triangles around the vertex, in any order; places in any one frame, metres
/// @return the most that a star around `shown_m` departs from the one around `place_m`, both ways, metres, falling to 0
///         towards the outer edges; nothing where the stars are no surfaces over one polygon
/// Cost: about 50 ns a triangle.
std::optional<double> slide_bound_m(const glm::dvec3& place_m, const glm::dvec3& shown_m,
                                    std::span<const OuterEdge> star);

}  // namespace lod
