// `harrier objects compare`: frame times of a timed scene with and without hierarchical dynamic levels of detail.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "lod/base/result.h"
#include "sim/command_values.h"

namespace sim {

struct ObjectsCompareArguments {
    std::string source;           ///< a cluster file; empty: the paper's scene
    bool is_paper_scene = false;  ///< the construction site, seed 0
    std::string report;
    double tolerance_px = 2.0;
    int still_frames = 9, animation_frames = 48;
    Size size{1280, 720};
    unsigned threads = 2;
};

void add_objects_compare(CLI::App& app, ObjectsCompareArguments& arguments);

/// Prints a table in Markdown and writes JSON when asked; progress on stderr.
lod::Result<lod::Ok> run_objects_compare(const ObjectsCompareArguments& arguments);

}  // namespace sim
