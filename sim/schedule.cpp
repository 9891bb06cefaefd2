#include "sim/schedule.h"

#include <algorithm>
#include <cmath>

namespace sim {

double schedule_s(const Schedule& schedule, int64_t elapsed_ns) {
    return schedule.anchor_s + schedule.rate * (static_cast<double>(elapsed_ns - schedule.anchor_ns) * 1e-9);
}

void set_rate(Schedule& schedule, int64_t elapsed_ns, double rate) {
    seek(schedule, elapsed_ns, schedule_s(schedule, elapsed_ns));
    schedule.rate = rate;
}

void seek(Schedule& schedule, int64_t elapsed_ns, double time_s) {
    schedule.anchor_s = time_s;
    schedule.anchor_ns = elapsed_ns;
}

void steer(Schedule& schedule, const render::Renderer::Input& input, int64_t elapsed_ns, double begin_s,
           double end_s) {
    constexpr double kSlowest = 1.0 / 1024.0, kFastest = 1024.0;
    double rate = schedule.rate;
    if (input.schedule_faster) rate = rate == 0.0 ? 1.0 : rate * 2.0;
    if (input.schedule_slower) rate *= 0.5;
    if (input.schedule_reverse) rate = -rate;
    if (rate != schedule.rate && rate != 0.0)
        set_rate(schedule, elapsed_ns, std::copysign(std::clamp(std::abs(rate), kSlowest, kFastest), rate));
    if (input.schedule_begin) seek(schedule, elapsed_ns, begin_s);
    if (input.schedule_end) seek(schedule, elapsed_ns, end_s);
}

}  // namespace sim
