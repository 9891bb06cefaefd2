// How the schedule is started from the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "sim/schedule.h"
#include "sim/world.h"

namespace sim {

struct ScheduleArguments {
    std::optional<double> seek_s;  ///< without: the flight's own time
    double rate = 1.0;
};

/// Declares --seek and --play.
void add_schedule(CLI::App& app, ScheduleArguments& arguments);

/// @param begin_s  simulation time of the flight's first frame
Schedule schedule_at_begin(const ScheduleArguments& arguments, double begin_s);

/// The latest event of what the world shows by schedule, edits of the ground included, s; 0 when it shows nothing so.
double schedule_end_s(const World& world);

}  // namespace sim
