// Building a vertex hierarchy, from triangles to proved errors: weld, decimate, prove, bound.
#pragma once

#include "lod/base/result.h"
#include "lod/progressive/decimate.h"
#include "lod/progressive/surface_mesh.h"
#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

struct BuildOptions {
    double weld_m = 0.0;  ///< places no farther apart become one
    DecimateOptions decimate;
};

/// Fails as make_manifold does. Deterministic.
/// Cost: about 12 us a triangle.
Result<VertexHierarchy> build_hierarchy(const SurfaceMesh& mesh, const BuildOptions& options,
                                        MeshReport& report);

}  // namespace lod
