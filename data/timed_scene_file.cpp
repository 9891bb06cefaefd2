#include "data/timed_scene_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "data/city_json.h"
#include "data/fbx_schedule.h"
#include "data/polygon_mesh.h"
#include "data/schedule_csv.h"
#include "data/source_scene.h"

namespace data {

namespace {

std::string extension_of(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

/// The schedule that goes with a scene; empty when there is none.
std::string schedule_path_of(const std::string& path, const TimedSceneOptions& options) {
    if (!options.schedule.empty()) return options.schedule;
    const std::filesystem::path beside = std::filesystem::path(path).replace_extension(".csv");
    std::error_code problem;
    return std::filesystem::is_regular_file(beside, problem) ? beside.string() : std::string();
}

lod::Result<SourceScene> read_source(const std::string& path, const std::string& extension,
                                     const Schedule& schedule) {
    if (extension == ".csv") return SourceScene{};
    if (extension == ".json") return read_city_json(path);
    const auto model = read_shared_model(path);
    if (!model) return model.error();
    SourceScene source = objects_of_model(*model, schedule);
    if (extension == ".fbx") {
        if (const auto added = add_fbx_schedule(path, source); !added) return added.error();
    }
    return source;
}

}  // namespace

lod::Result<TimedScene> read_timed_scene(const std::string& path, const TimedSceneOptions& options) {
    return give_schedule(path, options, [&](const Schedule& schedule) {
        return read_source(path, extension_of(path), schedule);
    });
}

lod::Result<TimedScene> give_schedule(const std::string& path, const TimedSceneOptions& options,
                                      const std::function<lod::Result<SourceScene>(const Schedule&)>& read) {
    const std::string schedule_path = schedule_path_of(path, options);
    Schedule schedule;
    if (!schedule_path.empty()) {
        auto from_file = read_schedule(schedule_path);
        if (!from_file) return from_file.error();
        schedule = std::move(*from_file);
    }
    auto source = read(schedule);
    if (!source) return source.error();
    auto scene = schedule_scene(std::move(*source), schedule, schedule_path.empty() ? path : schedule_path);
    if (!scene) return scene.error();
    if (scene->objects.empty()) return lod::Error{path + ": not a single object, expected a scene"};
    return scene;
}

}  // namespace data
