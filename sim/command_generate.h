// `harrier objects generate` and `convert`: timed scenes made by seed, or read from models, cities and schedules, as
// files that others read too.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "data/scenes/scene_family.h"
#include "lod/base/result.h"

namespace sim {

struct GenerateArguments {
    std::string family = "site";
    data::FamilyOptions options;
    std::string out;
};

void add_generate(CLI::App& app, GenerateArguments& arguments);

/// Writes the scene and prints one line of JSON: objects and triangles by class, meshes, end, files.
lod::Result<lod::Ok> run_generate(const GenerateArguments& arguments);

struct ConvertArguments {
    std::string source, schedule, out;
};

void add_convert(CLI::App& app, ConvertArguments& arguments);

/// The same for a scene that objects::read_timed_scene reads.
lod::Result<lod::Ok> run_convert(const ConvertArguments& arguments);

}  // namespace sim
