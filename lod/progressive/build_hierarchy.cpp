#include "lod/progressive/build_hierarchy.h"

#include <thread>

#include "lod/base/hand_over.h"
#include "lod/progressive/error_proof.h"
#include "lod/progressive/hierarchy_bounds.h"
#include "lod/progressive/manifold_mesh.h"

namespace lod {
namespace {

VertexHierarchy build_alone(const ManifoldMesh& mesh, const DecimateOptions& options) {
    ErrorProof proof(mesh.positions, mesh.triangles);
    VertexHierarchy hierarchy =
        decimate(mesh, options, [&proof](const CollapseStep& step) { proof.take(step); });
    hierarchy.error_m = proof.errors_m();
    bound_normals(hierarchy);
    bound_places(hierarchy);
    return hierarchy;
}

VertexHierarchy build_in_pairs(const ManifoldMesh& mesh, const DecimateOptions& options) {
    constexpr size_t kBatch = 256;
    HandOver<CollapseBatch> collapses;
    HandOver<StarMeasures> to_measure;
    std::jthread mapper([&] {
        SurfaceImage image(mesh.positions, mesh.triangles);
        for (auto batches = collapses.take(); !batches.empty(); batches = collapses.take()) {
            for (const CollapseBatch& batch : batches) {
                StarMeasures measures;
                for (size_t k = 0; k < batch.size(); ++k) {
                    if (k + 1 < batch.size()) image.expect(batch[k + 1]);
                    image.collapse(batch[k], measures);
                }
                to_measure.give(std::move(measures));
            }
        }
        to_measure.close();
    });
    CollapseBatch batch;
    VertexHierarchy hierarchy = decimate(mesh, options, [&](const CollapseStep& step) {
        batch.add(step);
        if (batch.size() == kBatch) collapses.give(std::exchange(batch, {}));
    });
    collapses.give(std::move(batch));
    collapses.close();
    bound_normals(hierarchy);
    StarBounds bounds(mesh.positions, 3 * mesh.triangles.size());
    PlaceBounds places(hierarchy);
    for (auto batches = to_measure.take(); !batches.empty(); batches = to_measure.take()) {
        for (const StarMeasures& measures : batches)
            places.take(bounds.take(measures));
    }
    hierarchy.error_m = bounds.errors_m();
    places.finish(hierarchy);
    return hierarchy;
}

}  // namespace

Result<VertexHierarchy> build_hierarchy(const SurfaceMesh& mesh, const BuildOptions& options,
                                        MeshReport& report) {
    const Result<ManifoldMesh> manifold = make_manifold(mesh, options.weld_m, report);
    if (!manifold) return manifold.error();
    return options.threads > 1 ? build_in_pairs(*manifold, options.decimate)
                               : build_alone(*manifold, options.decimate);
}

}  // namespace lod
