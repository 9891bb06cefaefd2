// Colours of a reduced soup: what a face stands for, averaged by area.
#pragma once

#include "objects/reduction/nearest_faces.h"

namespace objects {

/// Gives each opaque face of `result` the mean colour of the opaque faces of `source` that are nearer to it than to others
/// and face much the same way or the opposite, weighted by area: windows that are gone darken their wall. Faces that
/// nothing is near to keep their colour. Means are of light (squares of sRGB), not of numbers.
/// @param nearest  faces of `result` near those of `source`
/// Cost: O(n). Deterministic.
void recolour(const FaceSoup& source, const NearestFaces& nearest, FaceSoup& result);

}  // namespace objects
