#include "sim/mesh_model.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "data/file_bytes.h"
#include "lod/base/parallel.h"
#include "lod/draw_list.h"
#include "lod/progressive/hpm_format.h"
#include "sim/whole_file.h"

namespace sim {
namespace {

constexpr size_t kMostFile_bytes = size_t{4} << 30;

lod::Material material_of(const data::MeshMaterial& material) {
    if (material.colour.w < 0.5f) return lod::Material::kGlass;
    return material.emission > 0.5f ? lod::Material::kGlow : lod::Material::kPaint;
}

/// A node's triangles of glass, or all others.
lod::SurfaceMesh surface_of(const data::PolygonMesh& mesh, const data::MeshNode& node, bool is_glass) {
    constexpr size_t kMaterials = 8;
    lod::SurfaceMesh surface;
    std::vector<uint32_t> kept(node.positions.size() * kMaterials, UINT32_MAX);
    for (size_t t = 0; t < node.triangles.size(); ++t) {
        const lod::Material material = material_of(mesh.materials[node.triangle_material[t]]);
        if ((material == lod::Material::kGlass) != is_glass) continue;
        std::array<uint32_t, 3> triangle{};
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t vertex = node.triangles[t][k];
            uint32_t& index = kept[vertex * kMaterials + static_cast<size_t>(material)];
            if (index == UINT32_MAX) {
                index = static_cast<uint32_t>(surface.positions.size());
                surface.positions.push_back(node.positions[vertex]);
                surface.normals.push_back(node.normals[vertex]);
                surface.colours.emplace_back(glm::u8vec3(node.colours[vertex]),
                                             static_cast<uint8_t>(material));
            }
            triangle[k] = index;
        }
        surface.triangles.push_back(triangle);
    }
    return surface;
}

/// A part before its hierarchy is built.
struct PartPlan {
    uint32_t node = 0;
    bool is_glass = false;
    lod::SurfaceMesh surface;
    std::optional<lod::Error> failure;
};

std::vector<PartPlan> plan_parts(const data::PolygonMesh& mesh) {
    std::vector<PartPlan> plans;
    for (uint32_t node = 0; node < mesh.nodes.size(); ++node) {
        for (const bool is_glass : {false, true}) {
            PartPlan plan{node, is_glass, surface_of(mesh, mesh.nodes[node], is_glass), std::nullopt};
            if (!plan.surface.triangles.empty()) plans.push_back(std::move(plan));
        }
    }
    return plans;
}

/// The part with more than half of all triangles; the number of parts: none.
size_t main_part_of(const std::vector<PartPlan>& plans) {
    size_t all = 0;
    for (const PartPlan& plan : plans)
        all += plan.surface.triangles.size();
    const auto is_main = [all](const PartPlan& plan) { return 2 * plan.surface.triangles.size() > all; };
    return static_cast<size_t>(std::find_if(plans.begin(), plans.end(), is_main) - plans.begin());
}

bool has_area(const lod::SurfaceMesh& surface) {
    return std::any_of(surface.triangles.begin(), surface.triangles.end(), [&](const auto& t) {
        const glm::vec3 &a = surface.positions[t[0]], &b = surface.positions[t[1]],
                        &c = surface.positions[t[2]];
        return a != b && b != c && c != a;
    });
}

}  // namespace

lod::Result<lod::ProgressiveModel> build_model(const data::PolygonMesh& mesh,
                                               const lod::BuildOptions& options, unsigned threads) {
    lod::ProgressiveModel model;
    model.file_from_model = mesh.file_from_model;
    for (const data::MeshNode& node : mesh.nodes)
        model.nodes.push_back({node.name, node.parent, node.parent_from_node});
    std::vector<PartPlan> plans = plan_parts(mesh);
    std::erase_if(plans, [](const PartPlan& plan) { return !has_area(plan.surface); });
    if (plans.empty()) return lod::Error{"no triangle with three different corners; expected at least one"};
    model.parts.resize(plans.size());
    const auto build = [&](size_t i, unsigned part_threads) {
        lod::ProgressivePart& part = model.parts[i];
        part.node = plans[i].node;
        part.is_glass = plans[i].is_glass;
        lod::BuildOptions part_options = options;
        part_options.threads = part_threads;
        lod::Result<lod::VertexHierarchy> built =
            lod::build_hierarchy(plans[i].surface, part_options, part.report);
        if (built)
            part.hierarchy = std::move(*built);
        else
            plans[i].failure = built.error();
    };
    // A part that would keep one thread busy when all others are done has them all first.
    const size_t main_part = main_part_of(plans);
    if (main_part < plans.size()) build(main_part, threads);
    std::atomic<size_t> next{0};
    lod::parallel_for(plans.size(), threads, [&](size_t, size_t) {
        for (size_t i = next++; i < plans.size(); i = next++)
            if (i != main_part) build(i, 1);
    });
    for (const PartPlan& plan : plans) {
        if (plan.failure)
            return lod::Error{"node '" + model.nodes[plan.node].name + "': " + plan.failure->message};
    }
    return model;
}

double stretch_of(const glm::dmat4& transform) {
    const glm::dmat3 linear(transform);
    const glm::dmat3 squares = glm::transpose(linear) * linear;
    double most = 0.0;
    for (int column = 0; column < 3; ++column) {
        const glm::dvec3 sizes = glm::abs(squares[column]);
        most = std::max(most, sizes.x + sizes.y + sizes.z);
    }
    return glm::sqrt(most);
}

lod::Result<lod::Ok> write_hpm(const std::string& path, const lod::ProgressiveModel& model) {
    const std::vector<unsigned char> bytes = lod::encode_hpm(model);
    return write_whole(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

lod::Result<lod::ProgressiveModel> read_hpm(const std::string& path) {
    const lod::Result<std::vector<uint8_t>> bytes = data::read_file(path, kMostFile_bytes);
    if (!bytes) return bytes.error();
    lod::Result<lod::ProgressiveModel> model = lod::decode_hpm(*bytes);
    if (!model) return lod::Error{"progressive mesh '" + path + "' " + model.message()};
    return model;
}

}  // namespace sim
