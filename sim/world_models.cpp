#include "sim/world_models.h"

#include <fmt/format.h>

#include <filesystem>

#include "data/polygon_mesh.h"
#include "sim/mesh_model.h"
#include "sim/progress.h"

namespace sim {
namespace {

/// Reads a model and says what it lost on the way.
lod::Result<data::PolygonMesh> read_model(World& world, const std::string& path) {
    data::PolygonMeshStats stats;
    lod::Result<data::PolygonMesh> mesh = data::read_polygon_mesh(path, &stats);
    if (mesh && !stats.missing_files.empty()) {
        world.notes.push_back(
            fmt::format("{}: drawn in plain colours: {} of its textures or material files cannot be read, "
                        "the first is '{}'; expected it beside the model",
                        path, stats.missing_files.size(), stats.missing_files.front()));
    }
    if (mesh) say_progress(fmt::format("model: {}, {} triangles", path, mesh->triangle_count()));
    return mesh;
}

bool is_progressive(const std::string& path) {
    return std::filesystem::path(path).extension() == ".hpm";
}

/// A source where it stands.
struct Placed {
    const std::string& source;
    lod::BodyPose pose;
    std::span<const Drive> drives;
    bool must_adapt = false;  ///< its needles move in the world, which parts drawn whole do not
};

lod::Result<lod::Ok> add_rigid(const data::PolygonMesh& mesh, const Placed& placed, ModelParts& rigid) {
    const lod::Result<ModelParts> parts = make_model_parts(mesh, placed.pose, placed.drives);
    if (!parts) return lod::Error{placed.source + ": " + parts.message()};
    append_model(*parts, rigid);
    return lod::Ok{};
}

lod::Result<lod::Ok> add_adaptive(lod::ProgressiveModel model, const Placed& placed,
                                  AdaptiveModels& adaptive) {
    adaptive.learn(placed.source, std::move(model));
    if (auto added = adaptive.add(placed.source, placed.pose, placed.drives); !added)
        return lod::Error{placed.source + ": " + added.message()};
    return lod::Ok{};
}

lod::Result<lod::Ok> add_source(World& world, const Placed& placed, unsigned threads, SceneModels& out) {
    if (out.adaptive.knows(placed.source)) {
        if (auto added = out.adaptive.add(placed.source, placed.pose, placed.drives); !added)
            return lod::Error{placed.source + ": " + added.message()};
        return lod::Ok{};
    }
    if (is_progressive(placed.source)) {
        lod::Result<lod::ProgressiveModel> model = read_hpm(placed.source);
        if (!model) return model.error();
        return add_adaptive(std::move(*model), placed, out.adaptive);
    }
    const lod::Result<data::PolygonMesh> mesh = read_model(world, placed.source);
    if (!mesh) return mesh.error();
    if (mesh->triangle_count() < kLeastAdaptiveTriangles && !placed.must_adapt)
        return add_rigid(*mesh, placed, out.rigid);
    const Stopwatch watch;
    lod::Result<lod::ProgressiveModel> model = build_model(*mesh, {}, threads);
    if (!model && placed.must_adapt) return lod::Error{placed.source + ": " + model.message()};
    if (!model) {
        world.notes.push_back(fmt::format("{}: drawn whole: {}", placed.source, model.message()));
        return add_rigid(*mesh, placed, out.rigid);
    }
    say_progress(
        fmt::format("model: {} parts made progressive in {:.1f} s", model->parts.size(), watch.seconds()));
    return add_adaptive(std::move(*model), placed, out.adaptive);
}

lod::MeshOptions mesh_options(const WorldOptions& options) {
    lod::MeshOptions mesh;
    mesh.ranks.tolerance_px = options.tolerance_px;
    mesh.glide_s = options.glide_s;
    return mesh;
}

}  // namespace

lod::BodyPose standing_pose(const World& world, const ModelSource& source) {
    data::SitePoint site{source.site.x, source.site.y, 0.0};
    site.height_m = ground_height_m(world, site) + source.height_m;
    return placed_pose(world.frame, site, source.heading_rad, source.scale);
}

lod::Result<lod::Ok> add_models(World& world, const WorldOptions& options, SceneModels& out) {
    for (const ModelSource& source : world.scene.models) {
        const auto first_body = static_cast<uint32_t>(out.rigid.bodies.size());
        const uint32_t first_pose = out.adaptive.pose_count();
        const lod::BodyPose pose = standing_pose(world, source);
        const Placed placed{source.source, pose, source.drives, !source.drives.empty()};
        if (auto added = add_source(world, placed, options.threads, out); !added) return added.error();
        const bool adapts = out.adaptive.pose_count() > first_pose;
        world.standing_models.push_back({source, adapts ? first_pose : first_body, adapts});
    }
    if (out.adaptive.is_empty()) return lod::Ok{};
    world.models = out.adaptive.make_front(lod::Module::kObjects, mesh_options(options), world.models_rig);
    world.item_count += world.models->item_count();
    return lod::Ok{};
}

lod::Result<lod::Ok> build_instruments(World& world, const WorldOptions& options) {
    if (world.scene.instruments.empty()) return lod::Ok{};
    SceneModels models;
    for (const InstrumentSource& source : world.scene.instruments) {
        const lod::BodyPose pose = cockpit_pose(source.position_eye_m, source.heading_rad, source.scale);
        if (auto added =
                add_source(world, {source.source, pose, source.drives, false}, options.threads, models);
            !added)
            return added.error();
    }
    ModelParts& rigid = models.rigid;
    if (!rigid.parts.empty()) {
        world.item_count += static_cast<uint32_t>(rigid.parts.size());
        world.cockpit = {std::move(rigid.moving), rigid.bodies};
        world.instruments = std::make_unique<lod::RigidFront>(
            lod::Module::kInstruments, std::move(rigid.parts), std::move(rigid.bodies));
    }
    if (models.adaptive.is_empty()) return lod::Ok{};
    world.panel =
        models.adaptive.make_front(lod::Module::kInstruments, mesh_options(options), world.panel_rig);
    world.item_count += world.panel->item_count();
    return lod::Ok{};
}

}  // namespace sim
