// `harrier demo`: the main job on the bundled scene, with a report, pictures and figures to look at.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "lod/base/result.h"
#include "sim/schedule_options.h"
#include "sim/world.h"

namespace sim {

struct DemoArguments {
    std::string scene;        ///< empty: the bundled one
    std::string out = "out";  ///< folder
    ScheduleArguments schedule;
    int batch = WorldOptions{}.batch;  ///< k of the terrain's leaves
    unsigned threads = 2;
};

void add_demo(CLI::App& app, DemoArguments& arguments);

/// Flies, takes pictures, writes report.json, summary.txt and PNGs into the folder and prints the summary.
lod::Result<lod::Ok> run_demo(const DemoArguments& arguments);

}  // namespace sim
