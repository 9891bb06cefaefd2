// Reads a timed scene from a file: models, FBX with its curves, CityJSON, with or without a schedule. Footprints: objects/building_scene.h.
#pragma once

#include <functional>
#include <string>

#include "data/source_scene.h"
#include "data/timed_scene.h"
#include "lod/base/result.h"

namespace data {

struct TimedSceneOptions {
    std::string
        schedule;  ///< CSV (data/schedule_csv.h); empty: the file `NAME.csv` beside `NAME.*`, if there is one
};

/// Reads by the file's kind:
///   .csv                a schedule alone, of models that it names
///   .json               CityJSON (data/city_json.h)
///   what Assimp opens   every node with triangles is an object, named by the node
/// Without a schedule everything is there for ever and T is 1. Fails on what the readers fail on.
lod::Result<TimedScene> read_timed_scene(const std::string& path, const TimedSceneOptions& options = {});

/// The same with a reader of its own for the source; the schedule tells it which objects will be asked for.
lod::Result<TimedScene> give_schedule(const std::string& path, const TimedSceneOptions& options,
                                      const std::function<lod::Result<SourceScene>(const Schedule&)>& read);

}  // namespace data
