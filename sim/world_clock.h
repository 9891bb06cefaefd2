// WorldClock: simulation time in integer nanoseconds; frame n has one exact time, however long the run.
//
// Nothing is accumulated: the time of a frame is a product, so a clock of three days ago and one just started
// agree to the nanosecond (docs/conventions.md). No clock of the machine is read here.
#pragma once

#include <cstdint>

namespace sim {

/// A fixed step, kept as a rate so that 60 Hz does not become 16,666,667 ns.
struct WorldClock {
    int64_t begin_ns = 0;
    int64_t rate_millihertz = 60000;  ///< in [1, 1,000,000,000]
};

/// A clock that starts at `begin_s` and makes `rate_hz` frames a second (both rounded to 1 ns and 0.001 Hz).
/// @param rate_hz in [0.001, 1,000,000]; CHECKed
WorldClock make_clock(double begin_s, double rate_hz);

/// Time of frame `frame` >= 0, rounded down to a nanosecond. Exact for spans of 292 years.
int64_t time_ns(const WorldClock& clock, int64_t frame);

/// The same in seconds, rounded once.
double time_s(const WorldClock& clock, int64_t frame);

/// Nanoseconds from frame 0 to frame `frame`.
int64_t since_begin_ns(const WorldClock& clock, int64_t frame);

}  // namespace sim
