#include "lod/progressive/build_hierarchy.h"

#include <future>
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
    HandOver<CollapseBatch> hand_over;
    std::promise<std::vector<float>> errors_m;
    std::jthread prover([&] {
        ErrorProof proof(mesh.positions, mesh.triangles);
        for (auto batches = hand_over.take(); !batches.empty(); batches = hand_over.take()) {
            for (const CollapseBatch& batch : batches)
                batch.for_each([&proof](const CollapseStep& step) { proof.take(step); });
        }
        errors_m.set_value(proof.errors_m());
    });
    CollapseBatch batch;
    VertexHierarchy hierarchy = decimate(mesh, options, [&](const CollapseStep& step) {
        batch.add(step);
        if (batch.size() == kBatch) hand_over.give(std::exchange(batch, {}));
    });
    hand_over.give(std::move(batch));
    hand_over.close();
    bound_normals(hierarchy);
    hierarchy.error_m = errors_m.get_future().get();
    bound_places(hierarchy);  // while the prover puts its things away
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
