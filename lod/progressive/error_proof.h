// Error proof: how far the triangles of a vertex hierarchy's collapses depart from its full mesh.
#pragma once

#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

/// Fills error_m by replaying the collapses under a SurfaceImage; a node's error is no less than its children's. What is
/// below 2^-40 of the largest coordinate counts as 0: the coordinates themselves are not known so well.
/// Cost: about 6 us a collapse.
void prove_errors(VertexHierarchy& hierarchy);

}  // namespace lod
