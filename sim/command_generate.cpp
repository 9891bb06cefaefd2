#include "sim/command_generate.h"

#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "data/scene_time.h"
#include "data/scenes/construction_site.h"
#include "objects/building_scene.h"
#include "sim/timed_scene_writer.h"
#include "sim/whole_file.h"

namespace sim {

namespace {

const std::map<std::string, data::SceneFamily> kFamilies = {{"highrise", data::SceneFamily::kHighRise},
                                                            {"group", data::SceneFamily::kGroup},
                                                            {"scattered", data::SceneFamily::kScattered}};

constexpr const char* kOutHelp =
    "NAME.glb: the scene, with its schedule in NAME.csv; NAME.fbx: both in one; without extension a folder";

void print_summary(const data::TimedScene& scene, const std::vector<std::string>& files) {
    const data::ClassCounts counts = data::count_classes(scene);
    nlohmann::json json = {{"end_s", scene.end_s}, {"meshes", scene.meshes.size()}, {"files", files}};
    const char* names[] = {"static", "pseudo_dynamic", "dynamic"};
    for (size_t i = 0; i < 3; ++i)
        json[names[i]] = {{"objects", counts.objects[i]}, {"triangles", counts.triangles[i]}};
    std::printf("%s\n", json.dump().c_str());
}

/// @param make  returns a Result<TimedScene>; called only when the files can be written
template <typename Make>
lod::Result<lod::Ok> write_made(const std::string& out, const Make& make) {
    const auto files = timed_scene_files(out);
    if (!files) return files.error();
    if (std::filesystem::path(out).has_extension()) {
        if (auto writable = check_writable(out); !writable) return writable.error();
    }
    const lod::Result<data::TimedScene> scene = make();
    if (!scene) return scene.error();
    if (auto written = write_timed_scene(*scene, out); !written) return written.error();
    print_summary(*scene, *files);
    return lod::Ok{};
}

}  // namespace

void add_generate(CLI::App& app, GenerateArguments& arguments) {
    data::FamilyOptions& options = arguments.options;
    app.add_option("--family", arguments.family,
                   "site: the construction site of docs/objects.md; or a family of buildings")
        ->check(CLI::IsMember({"site", "highrise", "group", "scattered"}))
        ->capture_default_str();
    app.add_option("--seed", options.seed, "equal seeds give equal scenes")
        ->capture_default_str()
        ->type_name("N");
    app.add_option("--out", arguments.out, kOutHelp)->required()->type_name("F.glb|F.fbx|DIR");
    const auto add = [&](const char* name, auto& value, const auto& range, const char* help) {
        app.add_option(name, value, help)->check(range)->capture_default_str()->group("Families");
    };
    add("--objects", options.objects, CLI::Range(1u, 10000000u), "number of objects");
    add("--triangles", options.triangles, CLI::Range(12u, 100000u), "triangles of each object");
    add("--sparsity", options.sparsity, CLI::Range(0.0, 0.99), "share of a building's cells that stay empty");
    add("--events", options.events_per_object, CLI::Range(0.0, 100.0),
        "mean number of times an object appears or disappears");
    add("--coherence", options.coherence, CLI::Range(0.0, 1.0),
        "1: erected along a Hilbert curve; 0: in any order");
    add("--moving", options.moving_share, CLI::Range(0.0, 1.0),
        "share of objects that are lifted to their places");
    add("--duration", options.end_s, CLI::Range(1e-3, 1e9), "seconds from beginning to end");
}

lod::Result<lod::Ok> run_generate(const GenerateArguments& arguments) {
    return write_made(arguments.out, [&]() -> lod::Result<data::TimedScene> {
        if (arguments.family == "site") return data::generate_construction_site(arguments.options.seed);
        data::FamilyOptions options = arguments.options;
        options.family = kFamilies.at(arguments.family);
        return data::generate_family(options);
    });
}

void add_convert(CLI::App& app, ConvertArguments& arguments) {
    app.add_option("scene", arguments.source,
                   "model, city or footprints: what Assimp or OGR opens, CityJSON, or a schedule")
        ->required()
        ->type_name("SCENE");
    app.add_option("--schedule", arguments.schedule,
                   "when objects appear, disappear and move; default: NAME.csv beside the scene")
        ->type_name("F.csv");
    app.add_option("--out", arguments.out, kOutHelp)->required()->type_name("F.glb|F.fbx|DIR");
}

lod::Result<lod::Ok> run_convert(const ConvertArguments& arguments) {
    return write_made(arguments.out, [&] {
        return objects::read_timed_scene(arguments.source, {.schedule = arguments.schedule});
    });
}

}  // namespace sim
