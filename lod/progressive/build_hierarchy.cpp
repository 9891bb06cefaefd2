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
    HandOver<std::vector<float>> errors_m;  // of the collapses' nodes
    std::jthread prover([&] {
        ErrorProof proof(mesh.positions, mesh.triangles);
        for (auto batches = collapses.take(); !batches.empty(); batches = collapses.take()) {
            for (const CollapseBatch& batch : batches) {
                std::vector<float> proved_m;
                for (size_t k = 0; k < batch.size(); ++k) {
                    if (k + 1 < batch.size()) proof.expect(batch[k + 1]);
                    proved_m.push_back(proof.take(batch[k]));
                }
                errors_m.give(std::move(proved_m));
            }
        }
        errors_m.close();
    });
    CollapseBatch batch;
    VertexHierarchy hierarchy = decimate(mesh, options, [&](const CollapseStep& step) {
        batch.add(step);
        if (batch.size() == kBatch) collapses.give(std::exchange(batch, {}));
    });
    collapses.give(std::move(batch));
    collapses.close();
    bound_normals(hierarchy);
    PlaceBounds places(hierarchy);
    std::vector<float> all_m(hierarchy.leaf_count, 0.0f);
    for (auto proved = errors_m.take(); !proved.empty(); proved = errors_m.take()) {
        for (const std::vector<float>& some_m : proved) {
            places.take(some_m);
            all_m.insert(all_m.end(), some_m.begin(), some_m.end());
        }
    }
    hierarchy.error_m = std::move(all_m);
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
