// A scene's path in real time on a machine that is none: what a frame takes is a formula of what was drawn, times the noise
// of shared_machine.h. Real fronts, scheduler and budget controller; no clock, so every run is the same.
//
//     budget_flight SCENE.toml [FRAMES [SEED [NOISE_ROOM]]]
//
// A line of JSON: late frames, times, errors told, triangles drawn. NOISE_ROOM instead of the frame loop's; beyond
// 1.4 no room is left for noise.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "sim/compare/statistics.h"
#include "sim/eyepoint.h"
#include "sim/frame_loop.h"
#include "sim/scene_file.h"
#include "sim/stage.h"
#include "sim/world.h"
#include "tests/bench/shared_machine.h"

namespace {

constexpr double kRate_hz = 30.0, kPeriod_ms = 1e3 / kRate_hz;
// The demo's frame, 33,000 triangles, takes 26.5 ms on the machine the noise was measured on.
constexpr double kFixed_ms = 3.4, kPerTriangle_ms = 7e-4;
constexpr uint64_t kOperations = 600;  ///< a frame
constexpr int kWarmUpFrames = 60;

int fail(const std::string& message) {
    std::fprintf(stderr, "%s\n", message.c_str());
    return 1;
}

}  // namespace

int main(int count, char** words) {
    if (count < 2) return fail("expected a scene file");
    const int frames = count > 2 ? std::max(std::atoi(words[2]), 1) : 300;
    sim::BudgetController controller;
    sim::LoopOptions loop;
    loop.rate_hz = kRate_hz;
    controller.target = sim::budget_target(loop);
    if (count > 4) controller.target.noise_room = std::atof(words[4]);
    bench::SharedMachine machine(count > 3 ? static_cast<uint64_t>(std::atoi(words[3])) : 11);

    const auto scene = sim::read_scene(words[1]);
    if (!scene) return fail(scene.message());
    sim::WorldOptions building;
    building.reserve_triangles = sim::reserve_for(loop);
    auto world = sim::build_world(*scene, building);
    if (!world) return fail(world.message());
    auto stage =
        sim::make_stage(std::move(*world), {.fov_y_rad = scene->start.fov_y_rad}, {.draws_frames = true});
    if (!stage) return fail(stage.message());

    std::vector<double> times_ms, errors_px, triangles;
    const double begin_s = scene->start.time_s.value_or(scene->time.begin_s);
    for (int frame = -kWarmUpFrames; frame < frames; ++frame) {
        const double time_s = begin_s + std::max(frame, 0) / kRate_hz;
        const sim::Shot shot{
            sim::pose_at(stage->world->eyepoint, time_s), {}, time_s, time_s, frame / kRate_hz};
        sim::Allowance allowance;
        allowance.budget.max_triangles = controller.triangles;
        allowance.deadline = lod::operation_limit(kOperations);
        const auto record = sim::make_frame(*stage, shot, allowance);
        if (!record) return fail(record.message());
        uint64_t drawn = 0;
        for (const uint64_t of_module : record->triangles)
            drawn += of_module;
        const double slowness = frame < 0 ? 1.0 : machine.slowness();
        const double ms = slowness * (kFixed_ms + kPerTriangle_ms * static_cast<double>(drawn));
        sim::observe(controller, record->drawn_triangles, ms);
        if (frame < 0) continue;
        times_ms.push_back(ms);
        errors_px.push_back(*std::max_element(record->error_px.begin(), record->error_px.end()));
        triangles.push_back(static_cast<double>(record->drawn_triangles));
    }
    const auto late =
        std::count_if(times_ms.begin(), times_ms.end(), [](double ms) { return ms > kPeriod_ms; });
    std::printf(
        "{\"frames\": %d, \"late\": %d, \"p50_ms\": %.1f, \"p95_ms\": %.1f, \"error_p50_px\": %.1f, "
        "\"error_p95_px\": %.1f, \"error_max_px\": %.1f, \"triangles_p50\": %.0f, \"triangles_p5\": %.0f}\n",
        frames, static_cast<int>(late), sim::percentile(times_ms, 0.5), sim::percentile(times_ms, 0.95),
        sim::percentile(errors_px, 0.5), sim::percentile(errors_px, 0.95), sim::percentile(errors_px, 1.0),
        sim::percentile(triangles, 0.5), sim::percentile(triangles, 0.05));
}
