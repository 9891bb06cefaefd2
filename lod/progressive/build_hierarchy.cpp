#include "lod/progressive/build_hierarchy.h"

#include "lod/progressive/error_proof.h"
#include "lod/progressive/hierarchy_bounds.h"
#include "lod/progressive/manifold_mesh.h"

namespace lod {

Result<VertexHierarchy> build_hierarchy(const SurfaceMesh& mesh, const BuildOptions& options,
                                        MeshReport& report) {
    const Result<ManifoldMesh> manifold = make_manifold(mesh, options.weld_m, report);
    if (!manifold) return manifold.error();
    VertexHierarchy hierarchy = decimate(*manifold, options.decimate);
    prove_errors(hierarchy);
    bound_nodes(hierarchy);
    return hierarchy;
}

}  // namespace lod
