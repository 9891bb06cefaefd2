#include "sim/command_clusters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "data/height_grid.h"
#include "data/scenes/construction_site.h"
#include "objects/building_scene.h"
#include "objects/clustering/cluster_build.h"
#include "sim/cluster_file.h"
#include "sim/command_values.h"
#include "sim/progress.h"
#include "sim/whole_file.h"

namespace sim {
namespace {

constexpr uint64_t kPaperSeed = 0;
constexpr const char* kClassNames[] = {"static", "pseudo_dynamic", "dynamic"};

uint64_t triangles_of(const objects::ClusterTree& tree, const objects::Cluster& cluster) {
    return cluster.geometry == objects::kNoGeometry ? 0 : tree.geometries[cluster.geometry].index_count / 3;
}

/// The scene to build from, its buildings on the terrain where there is one.
lod::Result<data::TimedScene> scene_of(const ClustersBuildArguments& arguments) {
    if (arguments.is_paper_scene) return data::generate_construction_site(kPaperSeed);
    const data::TimedSceneOptions reading{.schedule = arguments.schedule};
    if (arguments.terrain.empty()) return objects::read_timed_scene(arguments.source, reading);
    const auto grid = data::read_height_grid(arguments.terrain, {});
    if (!grid) return grid.error();
    return objects::read_timed_scene(arguments.source, reading, {grid->frame.world(), &*grid});
}

/// What the clusters of one level are.
struct LevelFacts {
    uint64_t clusters = 0, triangles = 0;
    double error_m = 0.0, gamma = 0.0;  ///< the largest that can be drawn
};

nlohmann::json levels_of(const objects::ClusterTree& tree) {
    std::map<uint16_t, LevelFacts> levels;
    for (const objects::Cluster& cluster : tree.clusters) {
        LevelFacts& level = levels[cluster.level];
        ++level.clusters;
        level.triangles += triangles_of(tree, cluster);
        if (cluster.error_m < objects::kNeverEnough_m)
            level.error_m = std::max(level.error_m, double(cluster.error_m));
        level.gamma = std::max(level.gamma, double(cluster.gamma));
    }
    nlohmann::json json = nlohmann::json::array();
    for (const auto& [number, level] : levels) {
        json.push_back({{"level", number},
                        {"clusters", level.clusters},
                        {"triangles", level.triangles},
                        {"error_m", level.error_m},
                        {"gamma", level.gamma}});
    }
    return json;
}

nlohmann::json facts_of(const objects::ClusterTree& tree) {
    std::array<uint64_t, 3> leaf_counts{}, triangle_counts{};
    for (objects::ClusterId id = 0; id < tree.clusters.size(); ++id) {
        const objects::Cluster& cluster = tree.clusters[id];
        if (!tree.is_leaf(id) || cluster.object == objects::kNoObject) continue;
        ++leaf_counts[static_cast<size_t>(cluster.motion_class)];
        triangle_counts[static_cast<size_t>(cluster.motion_class)] += triangles_of(tree, cluster);
    }
    nlohmann::json json = {{"objects", tree.object_count},
                           {"clusters", tree.clusters.size()},
                           {"geometries", tree.geometries.size()},
                           {"vertices", tree.vertices.size()},
                           {"triangles", tree.indices.size() / 3},
                           {"end_s", tree.end_s},
                           {"is_on_earth", tree.is_on_earth},
                           {"size_m", tree.clusters[objects::kRootCluster].size_m},
                           {"levels", levels_of(tree)}};
    for (size_t i = 0; i < 3; ++i)
        json[kClassNames[i]] = {{"leaves", leaf_counts[i]}, {"triangles", triangle_counts[i]}};
    return json;
}

}  // namespace

void add_clusters_build(CLI::App& app, ClustersBuildArguments& arguments) {
    CLI::App& scene = *app.add_option_group("scene")->require_option(1);
    scene
        .add_option("scene", arguments.source,
                    "model, city or footprints: what Assimp or OGR opens, CityJSON, or a schedule")
        ->type_name("SCENE");
    scene.add_flag("--paper-scene", arguments.is_paper_scene,
                   "instead: the generated construction site of 56,157 objects");
    app.add_option("--schedule", arguments.schedule,
                   "when objects appear, disappear and move; default: NAME.csv beside the scene")
        ->type_name("F.csv");
    app.add_option("--terrain", arguments.terrain, "rasters of heights that buildings stand on")
        ->type_name("DEM");
    app.add_option("--out", arguments.out, "file to write")->required()->type_name("F.hdlod");
    app.add_option("--levels", arguments.options.levels,
                   "of clusters; 0: as many doublings as lie between the objects' and the scene's size")
        ->check(CLI::Range(0u, 64u))
        ->type_name("L")
        ->capture_default_str();
    app.add_option("--levels-per-doubling", arguments.options.levels_per_doubling,
                   "unless --levels is given; more: draws less, builds longer, a larger file")
        ->check(CLI::Range(1u, 8u))
        ->type_name("N")
        ->capture_default_str();
    app.add_flag("--linear", arguments.options.is_linear,
                 "cluster sizes grow evenly from level to level, instead of doubling");
    app.add_option("--error-share", arguments.options.error_share,
                   "largest error of a level's clusters, as a share of their size")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    app.add_option(
           "--first-sizes", arguments.options.first_sizes,
           "unless --levels is given: size of the least clusters of several objects, in objects' sizes")
        ->check(CLI::Range(1.0, 64.0))
        ->capture_default_str();
    app.add_option("--spent-share", arguments.options.spent_share,
                   "error that what is reduced further may have, as a share of the level's; more: builds "
                   "faster, draws more")
        ->check(CLI::Range(0.0, 0.5))
        ->capture_default_str();
    app.add_option("--gamma-share", arguments.options.gamma_share,
                   "largest error in time of the last level, as a share of the schedule")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    add_threads(app, arguments.threads);
}

lod::Result<lod::Ok> run_clusters_build(const ClustersBuildArguments& arguments) {
    if (auto writable = check_writable(arguments.out); !writable) return writable.error();
    const Stopwatch reading;
    const auto scene = scene_of(arguments);
    if (!scene) return scene.error();
    say_progress(
        fmt::format("scene: {} objects, read in {:.1f} s", scene->objects.size(), reading.seconds()));
    const Stopwatch building;
    objects::BuildOptions options = arguments.options;
    options.threads = arguments.threads;
    objects::BuildCounts counts;
    const objects::ClusterTree tree =
        objects::build_cluster_tree(*scene, options, [&counts](const objects::BuildState& state) {
            say_progress(fmt::format("level {}: {} clusters so far", state.level, state.clusters));
            counts = state.counts;
        });
    const double built_s = building.seconds();
    const auto size_bytes = write_cluster_file(arguments.out, tree);
    if (!size_bytes) return size_bytes.error();
    say_progress(
        fmt::format("{}: {:.1f} MB, built in {:.1f} s", arguments.out, double(*size_bytes) * 1e-6, built_s));
    nlohmann::json facts = facts_of(tree);
    facts["work"] = {{"nodes", counts.nodes}, {"steps", counts.steps}, {"faces", counts.faces}};
    std::printf("%s\n", facts.dump().c_str());
    return lod::Ok{};
}

void add_clusters_inspect(CLI::App& app, ClustersInspectArguments& arguments) {
    app.add_option("clusters", arguments.file, "a cluster file (objects build)")
        ->required()
        ->type_name("F.hdlod");
}

lod::Result<lod::Ok> run_clusters_inspect(const ClustersInspectArguments& arguments) {
    const auto tree = read_cluster_file(arguments.file);
    if (!tree) return tree.error();
    std::printf("%s\n", facts_of(*tree).dump().c_str());
    return lod::Ok{};
}

}  // namespace sim
