// `harrier fly`: runs the loop along the scene's path, a recording, or by hand in a window.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "lod/base/result.h"
#include "sim/command_values.h"
#include "sim/frame_loop.h"
#include "sim/schedule_options.h"
#include "sim/world.h"

namespace sim {

struct FlyArguments {
    std::string scene;
    std::optional<int64_t> frames;
    double rate_hz = 60.0;
    Size size;
    std::string trajectory;
    std::optional<double> time_s;
    ScheduleArguments schedule;
    std::optional<uint64_t> triangles;
    double tolerance_px = 1.0;
    double glide_s = WorldOptions{}.glide_s;
    std::optional<uint64_t> operations;
    int batch = WorldOptions{}.batch;  ///< k of the terrain's leaves
    unsigned threads = 2;
    std::string report;
    std::string images;
    int64_t every = 1;
    bool window = false;
};

/// Declares the options.
void add_fly(CLI::App& app, FlyArguments& arguments);

/// Fails with one line on bad input; a report is then not left behind.
lod::Result<lod::Ok> run_fly(const FlyArguments& arguments);

/// One line: frames, percentiles, missed, triangles, error.
std::string summary_line(double rate_hz, std::span<const FrameRecord> frames);

}  // namespace sim
