// The scene file: what a user writes in TOML, as plain data.
//
// Paths in the file are relative to the file. An unknown key, a wrong type and a number out of range are
// errors that name file and line. Angles are degrees in the file and radians here.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "data/height_grid.h"
#include "data/world_frame.h"
#include "lod/base/result.h"

namespace sim {

/// [terrain]
struct TerrainSource {
    std::vector<std::string> sources;  ///< at least one
    std::vector<std::string> imagery;
    data::VoidPolicy voids = data::VoidPolicy::kFill;  ///< a terrain store has its own
    double memory_mb = 512.0;                          ///< for the pages of a terrain store, at most
};

/// [[buildings]]
struct BuildingSource {
    std::string source;
    double default_height_m = 8.0;
};

/// [[objects]]: a cluster file. One that does not know its place on the Earth stands on the ground at `site`.
struct ObjectSource {
    std::string source;
    std::optional<glm::dvec2> site;  ///< longitude and latitude in degrees, or CRS x and y
    double height_m = 0.0;           ///< above ground
    double heading_rad = 0.0;        ///< clockwise from north
    int line = 0;                    ///< in the scene file
};

/// [[edits]]: relief that changes at a time, in the order of times, then as listed.
struct EditSource {
    enum class Kind : uint8_t { kCrater, kExcavation, kRaster };
    Kind kind = Kind::kCrater;
    std::string source;      ///< kRaster: heights that replace the terrain's
    glm::dvec2 site{0.0};    ///< else: longitude and latitude in degrees, or CRS x and y
    double radius_m = 0.0;   ///< of the rim's crest, or of the floor; > 0
    double depth_m = 0.0;    ///< below the ground
    double rim_m = 0.0;      ///< kCrater: above the ground
    double slope_rad = 0.0;  ///< kExcavation: of the sides
    double time_s = 0.0;     ///< in force from then on
    int line = 0;            ///< in the scene file
};

/// Which signal (signals.h) moves a part of a model or an instrument.
struct Drive {
    std::string node;  ///< name of the part in the model file
    int signal = 0;    ///< into kSignalNames
};

/// [[models]]: stands on the ground.
struct ModelSource {
    std::string source;
    glm::dvec2 site{0.0};       ///< longitude and latitude in degrees, or CRS x and y
    double height_m = 0.0;      ///< above ground
    double heading_rad = 0.0;   ///< clockwise from north
    double scale = 1.0;         ///< > 0
    std::vector<Drive> drives;  ///< sorted by node
};

/// [[instruments]]: fixed in the cockpit.
struct InstrumentSource {
    std::string source;
    glm::dvec3 position_eye_m{0.0, 0.0, -1.0};  ///< eye frame: +x right, +y up, -z ahead
    double heading_rad = 0.0;   ///< turns the model about its own vertical, clockwise from above
    double scale = 1.0;         ///< > 0
    std::vector<Drive> drives;  ///< sorted by node
};

/// [start]
struct StartPose {
    data::SitePoint site;
    double heading_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
    bool is_given = false;  ///< false: no camera in the file, the program chooses one
    double fov_y_rad = 1.0471975511965976;
    std::optional<double> time_s;
};

/// [path]
struct PathSource {
    enum class Kind : uint8_t { kRecorded, kFlight, kDrive };
    Kind kind = Kind::kFlight;
    std::string source;                      ///< kRecorded: the recording
    std::vector<data::SitePoint> waypoints;  ///< else: at least two
    double speed_mps = 60.0;                 ///< > 0
};

/// [time]
struct TimeSpan {
    double begin_s = 0.0;
    std::optional<double> end_s;  ///< > begin_s
};

struct Scene {
    std::string file;
    std::string name;
    std::optional<TerrainSource> terrain;
    std::vector<EditSource> edits;  ///< with terrain only
    std::vector<BuildingSource> buildings;
    std::vector<ObjectSource> objects;
    std::vector<ModelSource> models;
    std::vector<InstrumentSource> instruments;
    StartPose start;
    std::optional<PathSource> path;
    TimeSpan time;
};

/// Reads a scene file. Fails with "file:line: what, expected"; opens none of the files it names.
lod::Result<Scene> read_scene(const std::string& file);

}  // namespace sim
