// Colours of a reduced soup: what is seen of what a face stands for, averaged by area.
#pragma once

#include "lod/surface/triangle_tree.h"
#include "objects/reduction/nearest_faces.h"

namespace objects {

/// Gives each opaque face of `result` the mean colour of the opaque faces of `source` in whose place it is seen from its front
/// side, by area: windows that are gone darken their wall; the wall behind them and what is below a roof do not count. Of
/// what is not seen from there, what is seen from its back counts, else what is nearer to it than to other faces and faces
/// much the same way or the opposite. Faces that nothing is near to keep their colour. Two halves of a flat four-sided face get
/// one colour. A face of whose back more than twice as much is seen as of its front is turned over. Means are of light (squares
/// of sRGB), not of numbers.
/// @param source_tree  of `source`
/// @param nearest      faces of `result` near those of `source`, within `limit_m`
/// Cost: O(n log n), a look along four ways a face. Deterministic.
void recolour(const FaceSoup& source, const lod::TriangleTree& source_tree, const NearestFaces& nearest,
              double limit_m, FaceSoup& result);

}  // namespace objects
