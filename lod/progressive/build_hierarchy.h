// Building a vertex hierarchy, from triangles to proved errors: weld, decimate, prove, bound.
//
//     one thread    decimate ──────── cones, errors, spheres
//     the other        └─ batches ─ map ──┘
//
// The map (surface_image.h) needs nothing but the collapses, the errors (star_bounds.h) nothing but what the map says is to be
// measured, each in their order: the result is the same on one thread and on two.
#pragma once

#include "lod/base/result.h"
#include "lod/progressive/decimate.h"
#include "lod/progressive/surface_mesh.h"
#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

struct BuildOptions {
    double weld_m = 0.0;  ///< places no farther apart become one
    DecimateOptions decimate;
    unsigned threads = 1;  ///< two are used at the most; the result is the same for any number
};

/// Fails as make_manifold does. Deterministic.
/// Cost: about 12 us a triangle on one thread.
Result<VertexHierarchy> build_hierarchy(const SurfaceMesh& mesh, const BuildOptions& options,
                                        MeshReport& report);

}  // namespace lod
