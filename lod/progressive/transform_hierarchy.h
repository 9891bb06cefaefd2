// A vertex hierarchy in another frame.
#pragma once

#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

/// Moves all places by an affine map. Errors and spheres stay proved: they grow by the largest stretch. Cones survive
/// rotation times uniform scale; other maps leave none.
void transform_hierarchy(VertexHierarchy& hierarchy, const glm::dmat4& to_from_mesh);

}  // namespace lod
