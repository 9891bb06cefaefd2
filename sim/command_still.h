// `harrier still`: one picture, as good as the tolerance asks, or as a budget allows.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lod/base/result.h"
#include "sim/command_values.h"
#include "sim/world.h"

namespace sim {

struct StillArguments {
    std::string scene;
    std::vector<double> camera, eye, target;  ///< empty: not given
    std::optional<double> fov_deg;
    std::optional<double> time_s;
    double tolerance_px = 1.0;
    Size size{1280, 720};
    std::optional<uint64_t> triangles, operations;
    int batch = WorldOptions{}.batch;  ///< k of the terrain's leaves
    unsigned threads = 2;
    std::string image, depth, geometry;  ///< files to write
};

/// Declares the options.
void add_still(CLI::App& app, StillArguments& arguments);

/// Prints one line of JSON. Fails with one line on bad input.
lod::Result<lod::Ok> run_still(const StillArguments& arguments);

}  // namespace sim
