// The world clock against 128-bit integers, over days.
#include "sim/world_clock.h"

#include <gtest/gtest.h>

namespace {

__extension__ using Wide = __int128;

int64_t exact_ns(const sim::WorldClock& clock, int64_t frame) {
    return clock.begin_ns +
           static_cast<int64_t>(Wide(frame) * Wide(1'000'000'000'000) / Wide(clock.rate_millihertz));
}

TEST(WorldClock, ThreeDaysWithoutDrift) {
    for (const double rate_hz : {60.0, 30.0, 59.94, 1000.0, 0.001, 144.0, 23.976}) {
        const sim::WorldClock clock = sim::make_clock(0.0, rate_hz);
        const auto frames = static_cast<int64_t>(3.0 * 86400.0 * rate_hz);
        for (int64_t frame = 0; frame <= frames; frame += 1 + frames / 10007) {
            ASSERT_EQ(sim::time_ns(clock, frame), exact_ns(clock, frame))
                << rate_hz << " Hz, frame " << frame;
        }
    }
}

TEST(WorldClock, WholeSecondsFallOnFrames) {
    const sim::WorldClock clock = sim::make_clock(0.0, 60.0);
    EXPECT_EQ(sim::time_ns(clock, 60 * 259200), int64_t{259200} * 1'000'000'000);
    EXPECT_EQ(sim::time_ns(clock, 1), 16'666'666);
    EXPECT_EQ(sim::time_s(clock, 60 * 259200), 259200.0);
}

TEST(WorldClock, StepsDifferByOneNanosecondAtMost) {
    const sim::WorldClock clock = sim::make_clock(524288.0, 60.0);
    for (int64_t frame = 24'986'900; frame < 24'987'000; ++frame) {
        const int64_t step = sim::time_ns(clock, frame + 1) - sim::time_ns(clock, frame);
        EXPECT_TRUE(step == 16'666'666 || step == 16'666'667);
    }
}

TEST(WorldClock, LateBeginsKeepTheSteps) {
    const sim::WorldClock early = sim::make_clock(0.0, 60.0);
    for (const double begin_s : {86400.0, 524288.0, 1e6, 2147483648.0}) {
        const sim::WorldClock late = sim::make_clock(begin_s, 60.0);
        for (int64_t frame = 0; frame < 1000; ++frame) {
            ASSERT_EQ(sim::time_ns(late, frame) - late.begin_ns, sim::time_ns(early, frame));
        }
    }
}

TEST(WorldClock, ManyYearsStayInRange) {
    const sim::WorldClock clock = sim::make_clock(0.0, 1e6);
    const int64_t frame = int64_t{9'000'000'000} * 1'000'000;  // 285 years at 1 MHz
    EXPECT_EQ(sim::time_ns(clock, frame), exact_ns(clock, frame));
}

}  // namespace
