// Spheres and cones of a vertex hierarchy's nodes. They hold after rounding to float.
#pragma once

#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

/// Fills centre and radius_m from geometry and error_m: a point of the full mesh that a triangle stands for is within
/// error_m of it, so a sphere takes in its triangles plus their error.
void bound_places(VertexHierarchy& hierarchy);

/// Fills cone_axis and cone_cos from geometry alone.
void bound_normals(VertexHierarchy& hierarchy);

}  // namespace lod
