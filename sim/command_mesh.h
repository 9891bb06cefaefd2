// `harrier mesh build`, `extract`, `inspect` and `generate`: progressive meshes of instruments and other models.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "lod/base/result.h"

namespace sim {

struct MeshBuildArguments {
    std::string source, out, metric = "quadric";
    double weld_m = 0.0, max_turn_deg = 60.0, min_quality = 0.005;
    unsigned threads = 1;
};
struct MeshExtractArguments {
    std::string source, out;
    uint64_t triangles = 0;
    double tolerance_m = 0.0;
    bool is_by_triangles = false;
};
struct MeshInspectArguments {
    std::string source;
};

struct MeshGenerateArguments {
    std::string out;
    uint32_t triangles = 0;
};

void add_mesh_build(CLI::App& app, MeshBuildArguments& arguments);
void add_mesh_extract(CLI::App& app, MeshExtractArguments& arguments);
void add_mesh_inspect(CLI::App& app, MeshInspectArguments& arguments);
void add_mesh_generate(CLI::App& app, MeshGenerateArguments& arguments);

/// Reads a model, writes an .hpm file and prints one line of JSON: what went in, what was met, how long it took.
lod::Result<lod::Ok> run_mesh_build(const MeshBuildArguments& arguments);

/// Writes PLY in the axes and units of the file that the .hpm was built from, moving parts at rest.
lod::Result<lod::Ok> run_mesh_extract(MeshExtractArguments arguments);

/// Prints JSON: counts, levels and errors, in all and part by part.
lod::Result<lod::Ok> run_mesh_inspect(const MeshInspectArguments& arguments);

/// Writes a generated meter (data/generated_meter.h) as GLB.
lod::Result<lod::Ok> run_mesh_generate(const MeshGenerateArguments& arguments);

}  // namespace sim
