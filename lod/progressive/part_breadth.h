// Breadths of a mesh's connected parts, and what an error does to the looks of a thin one.
//
// A distance says little about a mark on a dial: half a millimetre broad, it is gone when its surface has moved by a
// quarter of a millimetre, and what is gone is seen until it is a fraction of a pixel. So where a part is thin an error
// counts for more. Broad parts count as they are.
#pragma once

#include <vector>

#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

/// The breadth of the connected part of the full mesh that each leaf belongs to.
///
/// @returns  [leaves] m: with a border twice the area over the border's length, a strip's width; closed four times the
///           volume over the area, a ball's 4/3 radii. 0: nothing of an area
/// Cost: O(n log n) of the full mesh.
std::vector<double> breadths_of_leaves(const VertexHierarchy& hierarchy);

/// An error as it is seen: itself where it is small beside the breadth, eight times itself from a quarter of it on: a bright
/// line is lost in its surroundings at about an eighth of a pixel. Rises with the error.
double seen_error_m(double error_m, double breadth_m);

}  // namespace lod
