// How evenly this machine works: frames of the same arithmetic at 30 Hz, 9 ms on one thread, then 15 ms on two, then sleep,
// as a software rasteriser's. No memory, no driver: what is late here is late whatever is drawn.
//
//     machine_noise [FRAMES]
//
// A line of JSON: late frames, times, shares of frames that take 1.3, 1.5 and 2 times the median.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "sim/compare/statistics.h"

namespace {

using Clock = std::chrono::steady_clock;
constexpr double kPeriod_ms = 1e3 / 30.0, kAlone_ms = 9.0, kTogether_ms = 15.0;

double ms_since(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

volatile double sink;
void work(long steps) {
    double x = 1.0;
    for (long i = 0; i < steps; ++i)
        x = x * 1.0000001 + 1e-9;
    sink = x;
}

/// The fastest of some readings.
double steps_per_ms() {
    constexpr long kSteps = 5'000'000;
    double best = 0.0;
    for (int i = 0; i < 5; ++i) {
        const auto begin = Clock::now();
        work(kSteps);
        best = std::max(best, kSteps / ms_since(begin));
    }
    return best;
}

}  // namespace

int main(int count, char** words) {
    const int frames = count > 1 ? std::max(std::atoi(words[1]), 1) : 300;
    const double pace = steps_per_ms();
    const auto alone = static_cast<long>(kAlone_ms * pace), together = static_cast<long>(kTogether_ms * pace);
    std::vector<double> times_ms;
    const auto begin = Clock::now();
    for (int frame = 0; frame < frames; ++frame) {
        std::this_thread::sleep_until(begin + std::chrono::microseconds(int64_t{100'000} * frame / 3));
        const auto frame_begin = Clock::now();
        work(alone);
        std::thread other(work, together);
        work(together);
        other.join();
        times_ms.push_back(ms_since(frame_begin));
    }
    const double usual_ms = sim::percentile(times_ms, 0.5);
    const auto share_above = [&](double limit_ms) {
        const auto above =
            std::count_if(times_ms.begin(), times_ms.end(), [=](double ms) { return ms > limit_ms; });
        return static_cast<double>(above) / frames;
    };
    std::printf(
        "{\"frames\": %d, \"late\": %.0f, \"p50_ms\": %.1f, \"p95_ms\": %.1f, \"p99_ms\": %.1f, "
        "\"above_1.3\": %.3f, \"above_1.5\": %.3f, \"above_2\": %.3f}\n",
        frames, share_above(kPeriod_ms) * frames, usual_ms, sim::percentile(times_ms, 0.95),
        sim::percentile(times_ms, 0.99), share_above(1.3 * usual_ms), share_above(1.5 * usual_ms),
        share_above(2.0 * usual_ms));
}
