#include "sim/schedule.h"

#include <gtest/gtest.h>

namespace sim {
namespace {

constexpr int64_t kSecond_ns = 1'000'000'000;

TEST(Schedule, PlaysAtItsRate) {
    EXPECT_DOUBLE_EQ(schedule_s({5.0, 0, 1.0}, 3 * kSecond_ns), 8.0);
    EXPECT_DOUBLE_EQ(schedule_s({5.0, 0, 3600.0}, kSecond_ns / 2), 1805.0);
    EXPECT_DOUBLE_EQ(schedule_s({5.0, 0, 0.0}, 1000 * kSecond_ns), 5.0);
    EXPECT_DOUBLE_EQ(schedule_s({5.0, 0, -2.0}, 10 * kSecond_ns), -15.0);
}

TEST(Schedule, KeepsItsTimeWhenTheRateChanges) {
    Schedule schedule{100.0, 0, 2.0};
    set_rate(schedule, 10 * kSecond_ns, -1.0);
    EXPECT_DOUBLE_EQ(schedule_s(schedule, 10 * kSecond_ns), 120.0);
    EXPECT_DOUBLE_EQ(schedule_s(schedule, 15 * kSecond_ns), 115.0);
    seek(schedule, 15 * kSecond_ns, 7.0);
    EXPECT_DOUBLE_EQ(schedule_s(schedule, 16 * kSecond_ns), 6.0);
}

TEST(Schedule, AccumulatesNothing) {
    Schedule schedule{0.0, 0, 1.0 / 3.0};
    const int64_t three_days_ns = 3 * 86400 * kSecond_ns;
    EXPECT_DOUBLE_EQ(schedule_s(schedule, three_days_ns), 86400.0);
}

TEST(Schedule, FollowsTheKeys) {
    Schedule schedule{10.0, 0, 1.0};
    render::Renderer::Input input;
    input.schedule_faster = true;
    steer(schedule, input, kSecond_ns, 0.0, 600.0);
    EXPECT_EQ(schedule.rate, 2.0);
    EXPECT_DOUBLE_EQ(schedule_s(schedule, kSecond_ns), 11.0);
    input = {};
    input.schedule_reverse = true;
    steer(schedule, input, 2 * kSecond_ns, 0.0, 600.0);
    EXPECT_DOUBLE_EQ(schedule_s(schedule, 3 * kSecond_ns), 11.0);
    input = {};
    input.schedule_end = true;
    steer(schedule, input, 3 * kSecond_ns, 0.0, 600.0);
    EXPECT_DOUBLE_EQ(schedule_s(schedule, 4 * kSecond_ns), 598.0);
    input = {};
    input.schedule_slower = true;
    for (int i = 0; i < 100; ++i)
        steer(schedule, input, 4 * kSecond_ns, 0.0, 600.0);
    EXPECT_EQ(schedule.rate, -1.0 / 1024.0);
    EXPECT_DOUBLE_EQ(schedule_s(schedule, 4 * kSecond_ns), 598.0);
}

TEST(Schedule, APausedOneStartsAgain) {
    Schedule schedule{10.0, 0, 0.0};
    render::Renderer::Input input;
    input.schedule_faster = true;
    steer(schedule, input, kSecond_ns, 0.0, 600.0);
    EXPECT_EQ(schedule.rate, 1.0);
    EXPECT_DOUBLE_EQ(schedule_s(schedule, 2 * kSecond_ns), 11.0);
}

}  // namespace
}  // namespace sim
