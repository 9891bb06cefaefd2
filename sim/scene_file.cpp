#include "sim/scene_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "sim/signals.h"
#include "sim/toml_table.h"

namespace sim {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr NumberRange kAngle{-3600.0, 3600.0};
constexpr NumberRange kHeight{-20000.0, 1e7};
constexpr NumberRange kScale{1e-6, 1e6};
constexpr NumberRange kTime{-1e9, 4e9};
constexpr double kRimShare = 0.2;  // of a crater's depth

/// Where relative paths of the file start, and the first problem.
struct Reading {
    std::filesystem::path folder;
    TomlProblem problem;

    std::string resolve(const std::string& path) const {
        return path.empty() ? path : (folder / path).lexically_normal().string();
    }
    void take_source(TomlTable& table, std::string& out) const {
        std::string path;
        table.require("source");
        table.take("source", path);
        out = resolve(path);
    }
};

TerrainSource read_terrain(const toml::value& value, Reading& reading) {
    TomlTable table(value, "[terrain]", reading.problem);
    TerrainSource terrain;
    table.require("sources");
    table.take("sources", terrain.sources);
    table.take("imagery", terrain.imagery);
    size_t policy = 0;
    table.take_word("voids", {"fill", "hole"}, policy);
    terrain.voids = policy == 0 ? data::VoidPolicy::kFill : data::VoidPolicy::kHole;
    table.take("memory_mb", terrain.memory_mb, {8.0, 1e6});
    table.finish();
    for (std::string& path : terrain.sources)
        path = reading.resolve(path);
    for (std::string& path : terrain.imagery)
        path = reading.resolve(path);
    return terrain;
}

EditSource read_edit(const toml::value& value, Reading& reading) {
    TomlTable table(value, "[[edits]]", reading.problem);
    EditSource edit;
    edit.line = table.line();
    size_t kind = 0;
    table.require("kind");
    table.take_word("kind", {"crater", "excavation", "raster"}, kind);
    edit.kind = static_cast<EditSource::Kind>(kind);
    table.require("time_s");
    table.take("time_s", edit.time_s, kTime);
    if (edit.kind == EditSource::Kind::kRaster) {
        reading.take_source(table, edit.source);
        table.finish();
        return edit;
    }
    std::vector<double> position;
    for (const char* key : {"position", "radius_m", "depth_m"})
        table.require(key);
    table.take("position", position, 2, 2);
    table.take("radius_m", edit.radius_m, {0.01, 1e5});
    table.take("depth_m", edit.depth_m, {0.0, 1e4});
    edit.rim_m = kRimShare * edit.depth_m;
    double slope_deg = 45.0;
    if (edit.kind == EditSource::Kind::kCrater) table.take("rim_m", edit.rim_m, {0.0, 1e4});
    if (edit.kind == EditSource::Kind::kExcavation) table.take("slope_deg", slope_deg, {1.0, 89.0});
    edit.slope_rad = slope_deg * kRadPerDeg;
    table.finish();
    position.resize(2, 0.0);
    edit.site = {position[0], position[1]};
    return edit;
}

BuildingSource read_buildings(const toml::value& value, Reading& reading) {
    TomlTable table(value, "[[buildings]]", reading.problem);
    BuildingSource buildings;
    reading.take_source(table, buildings.source);
    table.take("default_height_m", buildings.default_height_m, {0.1, 1000.0});
    table.finish();
    return buildings;
}

ObjectSource read_objects(const toml::value& value, Reading& reading) {
    TomlTable table(value, "[[objects]]", reading.problem);
    ObjectSource objects;
    reading.take_source(table, objects.source);
    objects.line = table.line();
    std::vector<double> position;
    double heading_deg = 0.0;
    table.take("position", position, 2, 2);
    table.take("height_m", objects.height_m, kHeight);
    table.take("heading_deg", heading_deg, kAngle);
    table.finish();
    if (position.size() == 2) objects.site = {position[0], position[1]};
    objects.heading_rad = heading_deg * kRadPerDeg;
    return objects;
}

/// What models and instruments share: source, heading, scale. @returns their place of `size` numbers; zeros where the
/// file has another, which is a problem then
template <typename Source>
std::vector<double> take_placed(TomlTable& table, const Reading& reading, const std::string& place_key,
                                size_t size, Source& out) {
    reading.take_source(table, out.source);
    std::vector<double> place;
    double heading_deg = 0.0;
    table.require(place_key);
    table.take(place_key, place, size, size);
    table.take("heading_deg", heading_deg, kAngle);
    table.take("scale", out.scale, kScale);
    out.heading_rad = heading_deg * kRadPerDeg;
    place.resize(size, 0.0);
    return place;
}

std::vector<Drive> read_drives(const toml::value& value, Reading& reading) {
    TomlTable table(value, "drives", reading.problem);
    std::vector<Drive> drives;
    for (const auto& [node, name] : table.take_all_strings()) {
        const int signal = signal_index(name);
        if (signal < 0) {
            std::string known;
            for (std::string_view other : kSignalNames)
                known += (known.empty() ? "" : ", ") + std::string(other);
            table.reject(node, fmt::format("is driven by \"{}\", expected one of: {}", name, known));
        }
        drives.push_back({node, signal});
    }
    return drives;
}

ModelSource read_model(const toml::value& value, Reading& reading) {
    TomlTable table(value, "[[models]]", reading.problem);
    ModelSource model;
    const std::vector<double> position = take_placed(table, reading, "position", 2, model);
    table.take("height_m", model.height_m, kHeight);
    if (const toml::value* drives = table.take_table("drives")) model.drives = read_drives(*drives, reading);
    table.finish();
    model.site = {position[0], position[1]};
    return model;
}

InstrumentSource read_instrument(const toml::value& value, Reading& reading) {
    TomlTable table(value, "[[instruments]]", reading.problem);
    InstrumentSource instrument;
    const std::vector<double> position = take_placed(table, reading, "position_m", 3, instrument);
    if (const toml::value* drives = table.take_table("drives"))
        instrument.drives = read_drives(*drives, reading);
    table.finish();
    instrument.position_eye_m = {position[0], position[1], position[2]};
    return instrument;
}

StartPose read_start(const toml::value& value, Reading& reading) {
    TomlTable table(value, "[start]", reading.problem);
    StartPose start;
    std::vector<double> camera;
    double fov_deg = 60.0, time_s = 0.0;
    table.take("camera", camera, 6, 6);
    table.take("fov_deg", fov_deg, {0.01, 170.0});
    table.take("time_s", time_s, kTime);
    if (table.has("time_s")) start.time_s = time_s;
    table.finish();
    start.fov_y_rad = fov_deg * kRadPerDeg;
    start.is_given = camera.size() == 6;
    if (start.is_given) {
        start.site = {camera[0], camera[1], camera[2]};
        start.heading_rad = camera[3] * kRadPerDeg;
        start.pitch_rad = camera[4] * kRadPerDeg;
        start.roll_rad = camera[5] * kRadPerDeg;
    }
    return start;
}

PathSource read_path(const toml::value& value, Reading& reading) {
    TomlTable table(value, "[path]", reading.problem);
    PathSource path;
    if (table.has("source")) {
        path.kind = PathSource::Kind::kRecorded;
        reading.take_source(table, path.source);
        table.finish();
        return path;
    }
    size_t kind = 0;
    if (!table.has("kind")) table.reject("kind", "is missing, expected a source or a kind of path");
    table.take_word("kind", {"flight", "drive"}, kind);
    path.kind = kind == 0 ? PathSource::Kind::kFlight : PathSource::Kind::kDrive;
    std::vector<std::vector<double>> waypoints;
    table.require("waypoints");
    table.take("waypoints", waypoints, kind == 0 ? 3 : 2, 3);
    table.take("speed_mps", path.speed_mps, {0.01, 20000.0});
    if (table.has("waypoints") && waypoints.size() < 2)
        table.reject("waypoints", "are too few, expected at least 2");
    table.finish();
    for (const std::vector<double>& p : waypoints)
        path.waypoints.push_back({p[0], p[1], p.size() > 2 ? p[2] : 0.0});
    return path;
}

TimeSpan read_time(const toml::value& value, Reading& reading) {
    TomlTable table(value, "[time]", reading.problem);
    TimeSpan time;
    double end_s = 0.0;
    table.take("begin_s", time.begin_s, kTime);
    table.take("end_s", end_s, kTime);
    if (table.has("end_s")) time.end_s = end_s;
    if (time.end_s && *time.end_s <= time.begin_s)
        table.reject("end_s", "is not after begin_s, expected a later time");
    table.finish();
    return time;
}

Scene read_root(const toml::value& root, Reading& reading) {
    TomlTable table(root, "the scene", reading.problem);
    Scene scene;
    scene.file = reading.problem.file;
    scene.name = std::filesystem::path(scene.file).stem().string();
    table.take("name", scene.name);
    if (const auto* value = table.take_table("terrain")) scene.terrain = read_terrain(*value, reading);
    for (const auto* value : table.take_tables("edits"))
        scene.edits.push_back(read_edit(*value, reading));
    if (!scene.edits.empty() && !scene.terrain)
        table.reject("edits", "have no ground to change, expected a [terrain] beside them");
    for (const auto* value : table.take_tables("buildings"))
        scene.buildings.push_back(read_buildings(*value, reading));
    for (const auto* value : table.take_tables("objects"))
        scene.objects.push_back(read_objects(*value, reading));
    for (const auto* value : table.take_tables("models"))
        scene.models.push_back(read_model(*value, reading));
    for (const auto* value : table.take_tables("instruments")) {
        scene.instruments.push_back(read_instrument(*value, reading));
    }
    if (const auto* value = table.take_table("start")) scene.start = read_start(*value, reading);
    if (const auto* value = table.take_table("path")) scene.path = read_path(*value, reading);
    if (const auto* value = table.take_table("time")) scene.time = read_time(*value, reading);
    table.finish();
    return scene;
}

/// The first sentence of the library's multi-line message, without its own decoration.
std::string first_line(std::string text) {
    text = text.substr(0, text.find('\n'));
    const size_t tag = text.find("[error] ");
    return tag == std::string::npos ? text : text.substr(tag + 8);
}

}  // namespace

lod::Result<Scene> read_scene(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    if (!stream || !(text << stream.rdbuf())) {
        return lod::Error{fmt::format("{}: cannot be read or is empty, expected a scene file (TOML)", file)};
    }
    Reading reading;
    reading.folder = std::filesystem::path(file).parent_path();
    reading.problem.file = file;
    try {
        std::istringstream input(text.str());
        const toml::value root = toml::parse(input, file);
        Scene scene = read_root(root, reading);
        if (!reading.problem.message.empty()) return lod::Error{reading.problem.message};
        return scene;
    } catch (const toml::exception& error) {
        return lod::Error{
            fmt::format("{}:{}: {}, expected TOML", file, error.location().line(), first_line(error.what()))};
    } catch (const std::exception& error) {
        return lod::Error{fmt::format("{}: {}, expected TOML", file, first_line(error.what()))};
    }
}

}  // namespace sim
