// Schedule: the time of what appears, disappears and moves. It plays, pauses, runs backwards and is sought, whatever
// the flight does meanwhile.
//
// Like the world's clock it accumulates nothing: a time is an anchor plus a product, and a change of rate or a jump sets
// a new anchor.
#pragma once

#include <cstdint>

#include "render/renderer.h"

namespace sim {

struct Schedule {
    double anchor_s = 0.0;  ///< schedule's time at anchor_ns
    int64_t anchor_ns = 0;  ///< of the flight, since its begin
    double rate = 1.0;      ///< seconds of the schedule in a second of flight; 0: paused; negative: backwards
};

/// The schedule's time, s, when the flight has lasted for `elapsed_ns`.
double schedule_s(const Schedule& schedule, int64_t elapsed_ns);

/// From here on at another rate.
void set_rate(Schedule& schedule, int64_t elapsed_ns, double rate);

/// Jumps to a time; the rate stays.
void seek(Schedule& schedule, int64_t elapsed_ns, double time_s);

/// Takes one step's keys: twice or half as fast (from 1/1024 to 1024), backwards, to the begin or the end.
/// @param begin_s, end_s  where the jumps lead
void steer(Schedule& schedule, const render::Renderer::Input& input, int64_t elapsed_ns, double begin_s,
           double end_s);

}  // namespace sim
