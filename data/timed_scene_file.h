// Reads a timed scene from whatever there is: models, FBX with its curves, footprints, CityJSON, with or without schedule.
#pragma once

#include <string>

#include "data/timed_scene.h"
#include "lod/base/result.h"

namespace data {

struct TimedSceneOptions {
    std::string
        schedule;  ///< CSV (data/schedule_csv.h); empty: the file `NAME.csv` beside `NAME.*`, if there is one
};

/// Reads by the file's kind:
///   .csv                a schedule alone, of models that it names
///   .json               CityJSON where the file says so (data/city_json.h), else as OGR's
///   what Assimp opens   every node with triangles is an object, named by the node
///   what OGR opens      footprints, every building an object, named by the source's id (data/footprints.h)
/// Without a schedule everything is there for ever and T is 1. Fails on what the readers fail on.
lod::Result<TimedScene> read_timed_scene(const std::string& path, const TimedSceneOptions& options = {});

}  // namespace data
