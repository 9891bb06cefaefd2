#include "sim/command_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "data/generated_meter.h"
#include "data/glb_writer.h"
#include "lod/progressive/static_mesh.h"
#include "sim/command_values.h"
#include "sim/mesh_model.h"
#include "sim/ply_writer.h"
#include "sim/progress.h"
#include "sim/whole_file.h"

namespace sim {
namespace {

constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;

nlohmann::json report_json(const lod::MeshReport& report) {
    return {{"vertices_in", report.vertices_in},
            {"triangles_in", report.triangles_in},
            {"places", report.places},
            {"collapsed_faces", report.collapsed_faces},
            {"duplicate_faces", report.duplicate_faces},
            {"zero_area_faces", report.zero_area_faces},
            {"border_edges", report.border_edges},
            {"non_manifold_edges", report.non_manifold_edges},
            {"non_manifold_vertices", report.non_manifold_vertices},
            {"locked_vertices", report.locked_leaves},
            {"seam_edges", report.seam_edges},
            {"components", report.components}};
}

/// Sums over parts.
lod::MeshReport total_report(const lod::ProgressiveModel& model) {
    lod::MeshReport sum;
    for (const lod::ProgressivePart& part : model.parts) {
        const lod::MeshReport& r = part.report;
        sum.vertices_in += r.vertices_in, sum.triangles_in += r.triangles_in, sum.places += r.places;
        sum.collapsed_faces += r.collapsed_faces, sum.duplicate_faces += r.duplicate_faces;
        sum.zero_area_faces += r.zero_area_faces, sum.border_edges += r.border_edges;
        sum.non_manifold_edges += r.non_manifold_edges;
        sum.non_manifold_vertices += r.non_manifold_vertices;
        sum.locked_leaves += r.locked_leaves, sum.seam_edges += r.seam_edges;
        sum.components += r.components;
    }
    return sum;
}

/// A chosen state of every part.
std::vector<lod::StaticMesh> choose_meshes(const lod::ProgressiveModel& model,
                                           const MeshExtractArguments& arguments) {
    const std::vector<glm::dmat4> transforms = lod::model_from_nodes(model);
    std::vector<lod::ScaledHierarchy> hierarchies;
    for (const lod::ProgressivePart& part : model.parts)
        hierarchies.push_back({&part.hierarchy, std::max(stretch_of(transforms[part.node]), 1e-300)});
    if (arguments.is_by_triangles) return lod::meshes_of_size(hierarchies, arguments.triangles);
    std::vector<lod::StaticMesh> meshes;
    for (const auto& [hierarchy, scale] : hierarchies)
        meshes.push_back(lod::mesh_at_tolerance(*hierarchy, arguments.tolerance_m / scale));
    return meshes;
}

/// Appends a part's triangles over the nodes they use.
void append_ply(const lod::VertexHierarchy& hierarchy, const lod::StaticMesh& mesh,
                const glm::dmat4& file_from_part, PlyMesh& ply) {
    std::vector<uint32_t> index(hierarchy.node_count(), UINT32_MAX);
    const bool is_mirrored = glm::determinant(glm::dmat3(file_from_part)) < 0.0;
    for (const auto& vertices : mesh.triangles) {
        std::array<uint32_t, 3> face{};
        for (size_t k = 0; k < 3; ++k) {
            const lod::NodeId node = hierarchy.vertex_node[vertices[k]];
            if (index[node] == UINT32_MAX) {
                index[node] = static_cast<uint32_t>(ply.vertices.size());
                ply.vertices.emplace_back(file_from_part *
                                          glm::dvec4(glm::dvec3(hierarchy.position[node]), 1.0));
            }
            face[is_mirrored ? 2 - k : k] = index[node];
        }
        ply.faces.push_back(face);
        ply.module.push_back(2);
    }
}

}  // namespace

void add_mesh_build(CLI::App& app, MeshBuildArguments& arguments) {
    app.add_option("model", arguments.source, "polygon model, anything Assimp opens")
        ->required()
        ->type_name("IN");
    app.add_option("--out", arguments.out, "progressive mesh to write")->required()->type_name("F.hpm");
    app.add_option("--metric", arguments.metric, "which edge goes first: least quadric error or shortest")
        ->check(CLI::IsMember({"quadric", "length"}))
        ->capture_default_str();
    app.add_option("--weld", arguments.weld_m, "vertices no farther apart than this become one, m")
        ->check(CLI::Range(0.0, 1e6))
        ->capture_default_str();
    app.add_option("--max-turn", arguments.max_turn_deg, "a collapse turns no normal by more, degrees")
        ->check(CLI::Range(0.0, 90.0))
        ->capture_default_str();
    app.add_option("--min-quality", arguments.min_quality,
                   "a collapse makes no worse triangle; 1 is equilateral")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    add_threads(app, arguments.threads);
}

void add_mesh_extract(CLI::App& app, MeshExtractArguments& arguments) {
    app.add_option("mesh", arguments.source, "progressive mesh")->required()->type_name("F.hpm");
    auto* by_size = app.add_option_group("size", "how fine");
    by_size->add_option("--triangles", arguments.triangles, "no more triangles than this")
        ->check(CLI::Range(1u, 2147483647u));
    by_size
        ->add_option("--tolerance", arguments.tolerance_m,
                     "no farther from the full mesh, m; 0: what is lossless")
        ->check(CLI::Range(0.0, 1e9));
    by_size->require_option(1);
    app.add_option("--out", arguments.out, "file to write, binary PLY")->required()->type_name("F.ply");
    app.parse_complete_callback([&arguments, by_size] {
        arguments.is_by_triangles = by_size->get_option("--triangles")->count() > 0;
    });
}

void add_mesh_inspect(CLI::App& app, MeshInspectArguments& arguments) {
    app.add_option("mesh", arguments.source, "progressive mesh")->required()->type_name("F.hpm");
}

void add_mesh_generate(CLI::App& app, MeshGenerateArguments& arguments) {
    arguments.triangles = data::kMeterTriangles;
    app.add_option("--out", arguments.out, "model to write, binary glTF")->required()->type_name("F.glb");
    app.add_option("--triangles", arguments.triangles, "exactly so many")
        ->check(CLI::Range(data::kLeastMeterTriangles, 10'000'000u))
        ->capture_default_str();
}

lod::Result<lod::Ok> run_mesh_generate(const MeshGenerateArguments& arguments) {
    const data::PolygonMesh mesh = data::generate_meter(arguments.triangles);
    if (auto written = data::write_glb(arguments.out, mesh); !written) return written.error();
    std::printf("%s\n", nlohmann::json{{"triangles", mesh.triangle_count()}}.dump().c_str());
    return lod::Ok{};
}

lod::Result<lod::Ok> run_mesh_build(const MeshBuildArguments& arguments) {
    if (auto writable = check_writable(arguments.out); !writable) return writable.error();
    const Stopwatch watch;
    const auto mesh = data::read_polygon_mesh(arguments.source);
    if (!mesh) return mesh.error();
    const double reading_s = watch.seconds();
    lod::BuildOptions options;
    options.weld_m = arguments.weld_m;
    options.decimate.metric =
        arguments.metric == "length" ? lod::CollapseMetric::kEdgeLength : lod::CollapseMetric::kQuadric;
    options.decimate.max_turn_cos = std::cos(arguments.max_turn_deg * kRadPerDeg);
    options.decimate.min_quality = arguments.min_quality;
    const auto model = build_model(*mesh, options, arguments.threads);
    if (!model) return lod::Error{arguments.source + ": " + model.message()};
    const double building_s = watch.seconds() - reading_s;
    if (auto written = write_hpm(arguments.out, *model); !written) return written.error();
    nlohmann::json json = report_json(total_report(*model));
    uint64_t triangles = 0;
    for (const lod::ProgressivePart& part : model->parts)
        triangles += part.hierarchy.triangles.size();
    json["parts"] = model->parts.size();
    json["triangles"] = triangles;
    json["reading_s"] = reading_s;
    json["building_s"] = building_s;
    json["total_s"] = watch.seconds();
    std::printf("%s\n", json.dump().c_str());
    return lod::Ok{};
}

lod::Result<lod::Ok> run_mesh_extract(MeshExtractArguments arguments) {
    if (auto writable = check_writable(arguments.out); !writable) return writable.error();
    const auto model = read_hpm(arguments.source);
    if (!model) return model.error();
    const std::vector<glm::dmat4> transforms = lod::model_from_nodes(*model);
    const std::vector<lod::StaticMesh> meshes = choose_meshes(*model, arguments);
    PlyMesh ply;
    double error_m = 0.0;
    uint64_t flipped = 0;
    uint32_t levels = 0;
    for (size_t i = 0; i < meshes.size(); ++i) {
        const lod::ProgressivePart& part = model->parts[i];
        append_ply(part.hierarchy, meshes[i], model->file_from_model * transforms[part.node], ply);
        error_m = std::max(error_m, meshes[i].error_m * stretch_of(transforms[part.node]));
        flipped += lod::count_flipped(part.hierarchy, meshes[i]);
        levels = std::max(levels, lod::count_levels(part.hierarchy));
    }
    if (auto written = write_ply(arguments.out, ply); !written) return written.error();
    const nlohmann::json json = {{"triangles", ply.faces.size()},
                                 {"vertices", ply.vertices.size()},
                                 {"error_m", error_m},
                                 {"flipped", flipped},
                                 {"levels", levels}};
    std::printf("%s\n", json.dump().c_str());
    return lod::Ok{};
}

lod::Result<lod::Ok> run_mesh_inspect(const MeshInspectArguments& arguments) {
    const auto model = read_hpm(arguments.source);
    if (!model) return model.error();
    const std::vector<glm::dmat4> transforms = lod::model_from_nodes(*model);
    nlohmann::json parts = nlohmann::json::array();
    uint64_t triangles = 0, vertices = 0, flipped = 0;
    double error_m = 0.0;
    uint32_t levels = 0;
    for (const lod::ProgressivePart& part : model->parts) {
        const lod::VertexHierarchy& h = part.hierarchy;
        const lod::StaticMesh base = lod::mesh_at_tolerance(h, 1e300);
        const double scale = stretch_of(transforms[part.node]);
        const uint64_t base_flipped = lod::count_flipped(h, base);
        parts.push_back({{"node", model->nodes[part.node].name},
                         {"is_glass", part.is_glass},
                         {"triangles", h.triangles.size()},
                         {"vertices", h.leaf_count},
                         {"drawn_vertices", h.vertex_count()},
                         {"collapses", h.collapse_count()},
                         {"base_triangles", base.triangles.size()},
                         {"base_flipped", base_flipped},
                         {"error_m", base.error_m * scale},
                         {"levels", lod::count_levels(h)},
                         {"report", report_json(part.report)}});
        triangles += h.triangles.size();
        vertices += h.leaf_count;
        flipped += base_flipped;
        error_m = std::max(error_m, base.error_m * scale);
        levels = std::max(levels, lod::count_levels(h));
    }
    nlohmann::json json = {{"triangles", triangles}, {"vertices", vertices},
                           {"error_m", error_m},     {"flipped", flipped},
                           {"levels", levels},       {"report", report_json(total_report(*model))}};
    json["parts"] = std::move(parts);
    std::printf("%s\n", json.dump().c_str());
    return lod::Ok{};
}

}  // namespace sim
