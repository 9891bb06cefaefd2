// Spheres and cones of a vertex hierarchy's nodes.
#pragma once

#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

/// Fills centre, radius_m, cone_axis and cone_cos from geometry and error_m: a point of the full mesh that a triangle
/// stands for is within error_m of it, so a sphere takes in its triangles plus their error.
/// Bounds hold after rounding to float.
void bound_nodes(VertexHierarchy& hierarchy);

}  // namespace lod
