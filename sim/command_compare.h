// `harrier terrain compare`: ROAM and its rivals on the same relief at equal measured errors.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "lod/base/result.h"
#include "sim/command_values.h"

namespace sim {

struct CompareArguments {
    std::vector<std::string> sources;
    int fractal_side = 0;  ///< samples; 0: the sources
    double fractal_relief_m = 300.0;
    std::string report;
    int frames = 120;
    Size size{1280, 720};
    unsigned threads = 1;
    std::vector<double> targets_px = {0.5, 1.0, 2.0, 4.0};
    std::vector<std::string> methods;
};

void add_compare(CLI::App& app, CompareArguments& arguments);

/// Prints two tables in Markdown and writes JSON when asked; progress on stderr.
lod::Result<lod::Ok> run_compare(const CompareArguments& arguments);

}  // namespace sim
