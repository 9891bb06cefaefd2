#include "sim/world_clock.h"

#include <cmath>

#include "lod/base/check.h"

namespace sim {
namespace {

constexpr int64_t kNsPerKilosecond = 1'000'000'000'000;  // one period of 1 mHz

/// a * b / c rounded down; a, b >= 0, 0 < c, b / c * a within range. a * b itself may not be.
int64_t multiply_divide(int64_t a, int64_t b, int64_t c) {
    // Long division: the high digit a / c, then the rest in two halves so that no product leaves 63 bits.
    const int64_t whole = a / c, rest = a % c;
    constexpr int64_t kHalf = 1'000'000;
    const int64_t high = rest * (b / kHalf);
    const int64_t low_digits = (high % c) * kHalf + rest * (b % kHalf);
    return whole * b + high / c * kHalf + low_digits / c;
}

}  // namespace

WorldClock make_clock(double begin_s, double rate_hz) {
    CHECK(rate_hz >= 0.001 && rate_hz <= 1e6);
    CHECK(std::abs(begin_s) < 9e9);
    return {std::llround(begin_s * 1e9), std::llround(rate_hz * 1e3)};
}

int64_t since_begin_ns(const WorldClock& clock, int64_t frame) {
    return multiply_divide(frame, kNsPerKilosecond, clock.rate_millihertz);
}

int64_t time_ns(const WorldClock& clock, int64_t frame) {
    return clock.begin_ns + since_begin_ns(clock, frame);
}

double time_s(const WorldClock& clock, int64_t frame) {
    return static_cast<double>(time_ns(clock, frame)) / 1e9;
}

}  // namespace sim
