#include "sim/schedule_options.h"

#include <algorithm>

namespace sim {

void add_schedule(CLI::App& app, ScheduleArguments& arguments) {
    app.add_option("--seek", arguments.seek_s,
                   "time of the schedule of [[objects]] at the first frame, s; default: the simulation's")
        ->check(CLI::Range(-1e12, 1e12))
        ->type_name("T");
    app.add_option("--play", arguments.rate,
                   "seconds of the schedule in a second of flight; 0: paused, negative: backwards")
        ->check(CLI::Range(-1e9, 1e9))
        ->type_name("RATE")
        ->capture_default_str();
}

Schedule schedule_at_begin(const ScheduleArguments& arguments, double begin_s) {
    return {arguments.seek_s.value_or(begin_s), 0, arguments.rate};
}

double schedule_end_s(const World& world) {
    double end_s = 0.0;
    for (const auto& site : world.sites)
        end_s = std::max(end_s, site->tree().end_s);
    if (!world.relief.edits.empty()) end_s = std::max(end_s, world.relief.edits.back().time_s);
    return end_s;
}

}  // namespace sim
