// Speed of the front of progressive meshes on one .hpm file: operations a second, and an orbit frame by frame.
//
// Usage: mesh_flight MODEL.hpm [TOLERANCE_PX] [FRAMES] [SAME.spm]
// With a file of OpenMesh-Analyzer of the same model, OpenMesh flies the same orbit, frame by frame in turn with ours.
// Prints one line of JSON. Rates and adaptation are by processor time, emission by the clock.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <nlohmann/json.hpp>
#include <numeric>

#include "data/file_bytes.h"
#include "lod/base/rng.h"
#include "lod/progressive/hpm_format.h"
#include "lod/progressive/mesh_front.h"
#include "lod/progressive/transform_hierarchy.h"
#include "lod/scheduler.h"
#include "tests/bench/openmesh_vdpm.h"

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// On the processor: rates over a second or so, whatever else the machine does.
double processor_s() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

std::vector<lod::ProgressiveMesh> meshes_of(const lod::ProgressiveModel& model) {
    const std::vector<glm::dmat4> model_from_node = lod::model_from_nodes(model);
    std::vector<lod::ProgressiveMesh> meshes;
    for (const lod::ProgressivePart& part : model.parts) {
        lod::VertexHierarchy hierarchy = part.hierarchy;
        lod::transform_hierarchy(hierarchy, model_from_node[part.node]);
        meshes.push_back(lod::make_progressive_mesh(std::move(hierarchy), part.is_glass));
    }
    return meshes;
}

const lod::ProgressiveMesh& largest(const std::vector<lod::ProgressiveMesh>& meshes) {
    return *std::max_element(meshes.begin(), meshes.end(), [](const auto& a, const auto& b) {
        return a.triangle_count() < b.triangle_count();
    });
}

/// Legal random operations on the largest part, each checked by its identifiers before it is done.
nlohmann::json operations_of_a_cut(const lod::ProgressiveMesh& mesh) {
    constexpr uint64_t kWanted = 2'000'000;
    lod::MeshCut cut(mesh);
    lod::Rng rng(1);
    uint64_t done = 0, asked = 0;
    const double begin_s = processor_s();
    while (done < kWanted) {
        const lod::NodeId node =
            mesh.leaf_count() + static_cast<lod::NodeId>(rng.below(mesh.hierarchy.collapse_count()));
        ++asked;
        const bool splits = done / 20'000 % 2 == 0;
        if (splits && cut.is_active(node) && cut.split_blocker(node) == lod::kNoNode) {
            cut.vsplit(node);
            ++done;
        } else if (!splits && !cut.is_active(node) && cut.are_children_active(node) &&
                   cut.collapse_blocker(node) == lod::kNoNode) {
            cut.ecol(node);
            ++done;
        } else if (asked % 100'000 == 0) {
            done += 20'000 - done % 20'000;  // nothing left to do this way
        }
        if (done % 20'000 == 0) cut.forget_touched();
    }
    const double s = processor_s() - begin_s;
    // Down to the coarsest and up to the full mesh in the build's order: no search, no refusals.
    double split_s = 0.0, collapse_s = 0.0;
    uint64_t splits = 0, collapses = 0;
    lod::MeshCut whole(mesh);
    for (int round = 0; round < 10; ++round) {
        const double splitting_s = processor_s();
        for (lod::NodeId node = mesh.hierarchy.node_count(); node-- > mesh.leaf_count();) {
            if (whole.split_blocker(node) != lod::kNoNode) continue;
            whole.vsplit(node);
            ++splits;
        }
        const double collapsing_s = processor_s();
        for (lod::NodeId node = mesh.leaf_count(); node < mesh.hierarchy.node_count(); ++node) {
            if (whole.collapse_blocker(node) != lod::kNoNode) continue;
            whole.ecol(node);
            ++collapses;
        }
        split_s += collapsing_s - splitting_s;
        collapse_s += processor_s() - collapsing_s;
    }
    return {{"random_per_s", double(done) / s},
            {"asked_per_s", double(asked) / s},
            {"vsplit_per_s", double(splits) / split_s},
            {"ecol_per_s", double(collapses) / collapse_s}};
}

struct Orbit {
    glm::dvec3 centre{0.0};
    double radius_m = 1.0, away_m = 4.0;
};

lod::View view_at(const Orbit& orbit, double angle_rad) {
    lod::View optics;
    optics.width_px = 1280;
    optics.height_px = 720;
    optics.near_m = 0.01 * orbit.radius_m;
    const glm::dvec3 way(std::cos(angle_rad), std::sin(angle_rad), 0.4);
    return lod::look_at(orbit.centre + glm::normalize(way) * orbit.away_m, orbit.centre, {0.0, 0.0, 1.0},
                        optics);
}

double rank(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    return values[static_cast<size_t>(std::max(std::ceil(share * double(values.size())), 1.0)) - 1];
}

/// Converges on the whole mesh at tolerance 0, and back, from a new place each time.
nlohmann::json operations_of_a_front(lod::MeshFront& front, const Orbit& orbit) {
    constexpr int kRounds = 10;
    lod::Front* fronts[] = {&front};
    std::array<double, 2> spent_s{};
    const lod::OperationCounts before = front.operations();
    for (int round = 0; round < 2 * kRounds; ++round) {
        const bool up = round % 2 == 0;
        lod::Budget budget;
        budget.tolerance_px = up ? 0.0 : 1e5;
        const lod::View view = view_at(orbit, 0.1 * round);
        const double begin_s = processor_s();
        front.begin_frame({&view, 1}, round / 60.0);
        lod::schedule(fronts, budget, lod::operation_limit(UINT64_MAX));
        spent_s[up ? 0 : 1] += processor_s() - begin_s;
    }
    const auto rate = [&](lod::OperationKind kind, double s) {
        return double(front.operations()[kind] - before[kind]) / s;
    };
    return {{"vsplit_per_s", rate(lod::OperationKind::kVsplit, spent_s[0])},
            {"ecol_per_s", rate(lod::OperationKind::kEcol, spent_s[1])}};
}

/// OpenMesh's vsplits alone, its legality asked each time: from the coarsest to the full mesh, as its synthesizer has it.
nlohmann::json operations_of_openmesh(std::span<const std::byte> spm) {
    double spent_s = 0.0;
    uint64_t splits = 0;
    for (int round = 0; round < 5; ++round) {
        bench::OpenMeshVdpm vdpm;
        vdpm.read(spm);
        const double begin_s = processor_s();
        vdpm.refine_fully();
        spent_s += processor_s() - begin_s;
        splits += vdpm.operations();
    }
    return {{"vsplit_per_s", double(splits) / spent_s}};
}

/// OpenMesh beside it, and what it took.
struct Companion {
    bench::OpenMeshVdpm vdpm;
    glm::dmat4 file_from_model{1.0};
    std::vector<double> adapt_ms, clean_ms;
    uint64_t triangles = 0, operations_before = 0;

    void fly(const lod::View& view, double tolerance_px, bool counts) {
        lod::View in_file = view;
        in_file.eye_world = glm::dvec3(file_from_model * glm::dvec4(view.eye_world, 1.0));
        in_file.eye_from_world = view.eye_from_world * glm::transpose(glm::dmat3(file_from_model));
        const double begin_s = processor_s();
        vdpm.adapt(in_file, tolerance_px);
        const double adapted_s = processor_s();
        vdpm.clean();
        if (!counts) {
            operations_before = vdpm.operations();
            return;
        }
        adapt_ms.push_back(1e3 * (adapted_s - begin_s));
        clean_ms.push_back(1e3 * (processor_s() - adapted_s));
        triangles += vdpm.triangles();
    }
    nlohmann::json report(int frames) const {
        return {{"triangles", double(triangles) / frames},
                {"operations", double(vdpm.operations() - operations_before) / frames},
                {"adapt_ms_p50", rank(adapt_ms, 0.5)},
                {"adapt_ms_p99", rank(adapt_ms, 0.99)},
                {"clean_ms_p50", rank(clean_ms, 0.5)}};
    }
};

nlohmann::json fly(lod::MeshFront& front, const Orbit& orbit, double tolerance_px, int frames,
                   Companion* beside) {
    lod::Front* fronts[] = {&front};
    lod::Budget budget;
    budget.tolerance_px = tolerance_px;
    lod::DrawList list;
    std::vector<double> adapt_ms, emit_ms;
    uint64_t operations = 0, triangles = 0, evaluations = 0, bytes = 0;
    for (int frame = 0; frame <= frames; ++frame) {
        const lod::View view = view_at(orbit, 0.002 * frame);
        const lod::OperationCounts before = front.operations();
        const uint64_t evaluated = front.evaluations();
        const double begin_s = processor_s();
        front.begin_frame({&view, 1}, frame / 60.0);
        lod::schedule(fronts, budget, lod::operation_limit(UINT64_MAX));
        const double adapted_s = processor_s() - begin_s;
        list.clear();
        const auto emitting = Clock::now();
        front.emit(view, list);
        const double emitted_ms = 1e3 * seconds_since(emitting);
        if (beside != nullptr) beside->fly(view, tolerance_px, frame > 0);
        if (frame == 0) continue;
        adapt_ms.push_back(1e3 * adapted_s);
        emit_ms.push_back(emitted_ms);
        const lod::OperationCounts now = front.operations();
        operations += now[lod::OperationKind::kVsplit] - before[lod::OperationKind::kVsplit] +
                      now[lod::OperationKind::kEcol] - before[lod::OperationKind::kEcol];
        evaluations += front.evaluations() - evaluated;
        triangles += front.triangles();
        for (const lod::IndexWrite& write : list.index_writes)
            bytes += write.indices.size_bytes();
    }
    const auto mean = [&](uint64_t sum) { return double(sum) / frames; };
    return {{"tolerance_px", tolerance_px},        {"triangles", mean(triangles)},
            {"operations", mean(operations)},      {"evaluations", mean(evaluations)},
            {"adapt_ms_p50", rank(adapt_ms, 0.5)}, {"adapt_ms_p99", rank(adapt_ms, 0.99)},
            {"emit_ms_p50", rank(emit_ms, 0.5)},   {"index_bytes", mean(bytes)},
            {"error_px", front.error_px()}};
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: mesh_flight MODEL.hpm [TOLERANCE_PX] [FRAMES] [SAME.spm]\n");
        return 2;
    }
    const double tolerance_px = argc > 2 ? std::atof(argv[2]) : 0.5;
    const int frames = argc > 3 ? std::atoi(argv[3]) : 600;
    const auto bytes = data::read_file(argv[1], size_t{4} << 30);
    if (!bytes) return std::fprintf(stderr, "%s\n", bytes.message().c_str()), 1;
    const auto model = lod::decode_hpm(*bytes);
    if (!model) return std::fprintf(stderr, "%s %s\n", argv[1], model.message().c_str()), 1;

    Companion beside;
    beside.file_from_model = model->file_from_model;
    const lod::Result<std::vector<uint8_t>> spm =
        argc > 4 ? data::read_file(argv[4], size_t{4} << 30) : lod::Error{"none"};
    if (argc > 4 && (!spm || !beside.vdpm.read(std::as_bytes(std::span(*spm)))))
        return std::fprintf(stderr, "%s: no progressive mesh of OpenMesh\n", argv[4]), 1;

    std::vector<lod::ProgressiveMesh> meshes = meshes_of(*model);
    nlohmann::json report;
    report["cut"] = operations_of_a_cut(largest(meshes));
    if (spm) report["openmesh_cut"] = operations_of_openmesh(std::as_bytes(std::span(*spm)));
    const lod::ProgressiveMesh& widest = *std::max_element(
        meshes.begin(), meshes.end(), [](const auto& a, const auto& b) { return a.radius_m < b.radius_m; });
    Orbit orbit{widest.centre, widest.radius_m, 0.0};
    std::vector<lod::MeshPlacement> placements(meshes.size());
    uint64_t full = 0;
    for (uint32_t i = 0; i < meshes.size(); ++i) {
        placements[i].mesh = i;
        full += meshes[i].triangle_count();
    }
    report["full_triangles"] = full;
    orbit.away_m = 3.0 * orbit.radius_m;
    lod::MeshOptions options;
    options.ranks.tolerance_px = tolerance_px;
    lod::MeshFront front(lod::Module::kInstruments, std::move(meshes), placements, options);
    front.place(front.pool_need());
    report["front"] = operations_of_a_front(front, orbit);
    report["orbit"] = fly(front, orbit, tolerance_px, frames, spm ? &beside : nullptr);
    if (spm) report["openmesh"] = beside.report(frames);
    std::printf("%s\n", report.dump().c_str());
    return 0;
}
