#include "sim/frame_loop.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "sim/pilot.h"
#include "sim/progress.h"
#include "sim/world_clock.h"

namespace sim {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr int kWarmUpFrames = 8;
constexpr double kRefineShare = 0.3;        // refinement never gets more of the period
constexpr double kLeastRefineShare = 0.02;  // nor less: a crowded frame must still be able to coarsen
constexpr double kMarginShare = 0.05;
constexpr double kTriangleShare = 0.85;  // what all but refinement may fill
constexpr double kLeastPerMs = 360.0;    // triangles a ms of the period: fewer save next to nothing

/// What the loop carries from frame to frame.
struct Loop {
    const LoopOptions& options;
    WorldClock clock;
    BudgetController controller;
    double rest_ms = 0.0;  ///< expected time of a frame without refinement
    Pilot pilot;
    Schedule schedule;
    double relief_ms = 0.0;  ///< what edits of the ground took of this frame, before its pose was known

    double period_ms() const { return 1e3 / options.rate_hz; }
};

Loop make_loop(const LoopOptions& options) {
    Loop loop{options, make_clock(options.begin_s, options.rate_hz), {}, 0.0, {}, options.schedule, 0.0};
    loop.controller.target = budget_target(options);
    loop.rest_ms = 0.5 * loop.period_ms();
    return loop;
}

lod::Deadline time_limit(double allowance_ms) {
    const auto end = SteadyClock::now() + std::chrono::duration_cast<SteadyClock::duration>(
                                              std::chrono::duration<double, std::milli>(allowance_ms));
    return [end](uint64_t) { return SteadyClock::now() >= end; };
}

Allowance allowance_of(const Loop& loop, int64_t frame) {
    Allowance allowance;
    allowance.frame = frame;
    allowance.budget.tolerance_px = loop.options.tolerance_px;
    if (loop.options.operations) {
        allowance.budget.max_triangles = loop.options.triangles.value_or(kDeterministicTriangles);
        allowance.deadline = lod::operation_limit(*loop.options.operations);
        return allowance;
    }
    allowance.budget.max_triangles = loop.options.triangles.value_or(loop.controller.triangles);
    const double period = loop.period_ms();
    const double left_ms = period * (1.0 - kMarginShare) - loop.rest_ms;
    allowance.deadline = time_limit(std::clamp(left_ms, kLeastRefineShare * period, kRefineShare * period));
    return allowance;
}

void learn(Loop& loop, const FrameRecord& record) {
    const double rest_ms = record.total_ms - record.refine_ms;
    loop.rest_ms +=
        (rest_ms > loop.rest_ms ? 0.5 : 0.1) * (std::min(rest_ms, 2.0 * loop.period_ms()) - loop.rest_ms);
    observe(loop.controller, record.drawn_triangles, rest_ms);
}

lod::Result<lod::Ok> warm_up(Loop& loop, Stage& stage) {
    bring_relief_to(stage, schedule_s(loop.schedule, 0));
    const double begin_s = loop.options.begin_s;
    const Shot shot{
        pose_at(stage.world->eyepoint, begin_s), {}, begin_s, schedule_s(loop.schedule, 0), begin_s};
    for (int i = 0; i < kWarmUpFrames; ++i) {
        Allowance allowance = allowance_of(loop, 0);
        allowance.deadline = time_limit(2.0 * loop.period_ms());
        auto record = make_frame(stage, shot, allowance);
        if (!record) return record.error();
        if (i >= kWarmUpFrames / 2) learn(loop, *record);  // the first ones pay for uploads and caches
    }
    return lod::Ok{};
}

/// What frame `frame` shows, `step` steps into the flight: the path, or the pilot who has taken over.
Shot next_shot(Loop& loop, Stage& stage, int64_t frame, int64_t step) {
    const double now_s = time_s(loop.clock, step);
    const int64_t elapsed_ns = since_begin_ns(loop.clock, step);
    const render::Renderer::Input input = stage.renderer.poll_input();
    steer(loop.schedule, input, elapsed_ns, 0.0, loop.options.schedule_end_s);
    const Stopwatch relief;
    bring_relief_to(stage, schedule_s(loop.schedule, elapsed_ns));
    loop.relief_ms = relief.ms();
    const EyeState path_state = pose_at(stage.world->eyepoint, now_s);
    steer(loop.pilot, input, *stage.world, path_state, 1.0 / loop.options.rate_hz);
    return {loop.pilot.is_free ? loop.pilot.state : path_state,
            {},
            now_s,
            schedule_s(loop.schedule, elapsed_ns),
            time_s(loop.clock, frame)};
}

}  // namespace

BudgetTarget budget_target(const LoopOptions& options) {
    const double period_ms = 1e3 / options.rate_hz;
    const uint64_t most = options.triangles.value_or(kMostTriangles);
    return {.frame_ms = kTriangleShare * period_ms,
            .noise_room = (1.0 - kMarginShare) / kTriangleShare,
            .min_triangles = std::min(static_cast<uint64_t>(kLeastPerMs * period_ms), most),
            .max_triangles = most};
}

uint64_t reserve_for(const LoopOptions& options) {
    constexpr uint64_t kForcedSplits = 4096;  // one refinement may overshoot by the splits it forces
    const uint64_t limit = options.operations ? kDeterministicTriangles : kMostTriangles;
    return options.triangles.value_or(limit) + kForcedSplits;
}

lod::Result<std::vector<FrameRecord>> run_loop(Stage& stage, const LoopOptions& options,
                                               const AfterFrame& after) {
    Loop loop = make_loop(options);
    const bool is_real_time = !options.operations;
    if (is_real_time) {
        if (auto warm = warm_up(loop, stage); !warm) return warm.error();
    }
    std::vector<FrameRecord> records;
    records.reserve(static_cast<size_t>(std::min<int64_t>(options.frames, 1'000'000)));
    SteadyClock::time_point begin = SteadyClock::now();
    int64_t step = 0;  // stands still while paused
    for (int64_t frame = 0; frame < options.frames && !loop.pilot.is_closing; ++frame) {
        if (is_real_time) {
            std::this_thread::sleep_until(begin +
                                          std::chrono::nanoseconds(since_begin_ns(loop.clock, frame)));
        }
        auto record = make_frame(stage, next_shot(loop, stage, frame, step), allowance_of(loop, frame));
        if (!record) return record.error();
        record->update_ms += loop.relief_ms;
        record->total_ms += loop.relief_ms;
        record->missed = record->total_ms > loop.period_ms();
        if (is_real_time) learn(loop, *record);
        records.push_back(*record);
        if (!loop.pilot.is_paused) ++step;

        const SteadyClock::time_point ended = SteadyClock::now();
        const auto goes_on = after(*record, stage);
        if (!goes_on) return goes_on.error();
        if (!*goes_on) break;
        begin += SteadyClock::now() - ended;  // what happens between frames is not theirs
    }
    return records;
}

}  // namespace sim
