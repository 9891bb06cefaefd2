#include "sim/command_fly.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "sim/progress.h"
#include "sim/whole_file.h"

namespace sim {
namespace {

constexpr double kDefaultSpan_s = 10.0;  // of a scene that states no end

/// Frames until the scene's end, or what the user asked for.
int64_t frame_count(const FlyArguments& arguments, const World& world, double begin_s) {
    if (arguments.frames) return *arguments.frames;
    if (arguments.window) return INT64_MAX;
    const std::optional<double> end = world.scene.time.end_s ? world.scene.time.end_s : end_s(world.eyepoint);
    const double span_s = end && *end > begin_s ? *end - begin_s : kDefaultSpan_s;
    return std::max<int64_t>(std::llround(span_s * arguments.rate_hz), 1);
}

LoopOptions loop_options(const FlyArguments& arguments) {
    LoopOptions options;
    options.rate_hz = arguments.rate_hz;
    options.tolerance_px = arguments.tolerance_px;
    options.triangles = arguments.triangles;
    options.operations = arguments.operations;
    return options;
}

lod::Result<lod::Ok> check_outputs(const FlyArguments& arguments) {
    if (!arguments.report.empty()) {
        if (auto writable = check_writable(arguments.report); !writable) return writable.error();
    }
    if (!arguments.images.empty()) {
        if (auto folder = make_folder(arguments.images); !folder) return folder.error();
    }
    return lod::Ok{};
}

AfterFrame picture_taker(const FlyArguments& arguments) {
    return [&arguments](const FrameRecord& record, Stage& stage) -> lod::Result<bool> {
        if (arguments.images.empty() || record.frame % arguments.every != 0) return true;
        const std::string name = fmt::format("frame_{:06}.png", record.frame);
        const std::string path = (std::filesystem::path(arguments.images) / name).string();
        if (auto written = render::write_png(path, stage.renderer.read_colour()); !written)
            return written.error();
        return true;
    };
}

lod::Result<lod::Ok> write_report(const FlyArguments& arguments, Stage& stage,
                                  std::span<const FrameRecord> frames) {
    if (arguments.report.empty()) return lod::Ok{};
    const RunFacts facts{arguments.scene,          arguments.rate_hz,       arguments.size.width_px,
                         arguments.size.height_px, stage.renderer.device(), resident_mb()};
    return write_whole(arguments.report, to_json(facts, frames).dump(1) + "\n");
}

}  // namespace

void add_fly(CLI::App& app, FlyArguments& arguments) {
    app.add_option("scene", arguments.scene, "scene file (TOML)")->required()->type_name("SCENE");
    app.add_option("--frames", arguments.frames,
                   "how many frames; default: to the end of the scene's time or path")
        ->check(CLI::Range(int64_t{1}, int64_t{1} << 40))
        ->type_name("N");
    app.add_option("--rate", arguments.rate_hz, "frames a second, Hz")
        ->check(CLI::Range(0.001, 1e6))
        ->type_name("HZ")
        ->capture_default_str();
    add_size(app, arguments.size);
    app.add_option("--trajectory", arguments.trajectory, "recording to follow instead of the scene's path")
        ->type_name("FILE");
    app.add_option("--time", arguments.time_s, "simulation time of the first frame, s; default: the scene's")
        ->check(CLI::Range(-1e9, 4e9))
        ->type_name("T0");
    add_schedule(app, arguments.schedule);
    app.add_option("--triangles", arguments.triangles,
                   "most triangles of geometry that adapts; default: what the rate "
                   "allows, or 40000 with --ops")
        ->check(CLI::Range(uint64_t{2}, uint64_t{100'000'000}))
        ->type_name("N");
    app.add_option("--tolerance", arguments.tolerance_px, "screen error to reach, pixels")
        ->check(CLI::Range(0.0, 1e6))
        ->type_name("PX")
        ->capture_default_str();
    app.add_option(
           "--glide", arguments.glide_s,
           "time a vertex of the terrain takes to its place, s; 0: it jumps, and the error told is the "
           "mesh's alone")
        ->check(CLI::Range(0.0, 60.0))
        ->type_name("S")
        ->capture_default_str();
    app.add_option("--ops", arguments.operations,
                   "deterministic: this many operations a frame, no clock decides")
        ->type_name("N");
    add_batch(app, arguments.batch);
    add_threads(app, arguments.threads);
    app.add_option("--report", arguments.report, "write a frame report, JSON")->type_name("FILE.json");
    app.add_option("--images", arguments.images, "write pictures into this folder, PNG")->type_name("DIR");
    app.add_option("--every", arguments.every, "with --images: each K-th frame")
        ->check(CLI::Range(int64_t{1}, int64_t{1} << 40))
        ->type_name("K")
        ->capture_default_str();
    app.add_flag("--window", arguments.window, "show a window; keys and mouse take over the flight");
}

std::string summary_line(double rate_hz, std::span<const FrameRecord> frames) {
    const Summary summary = summarise(frames);
    uint64_t triangles = 0;
    double error_px = 0.0;
    for (const FrameRecord& frame : frames) {
        uint64_t drawn = 0;
        for (uint64_t count : frame.triangles)
            drawn += count;
        triangles = std::max(triangles, drawn);
        error_px = std::max(error_px, *std::max_element(frame.error_px.begin(), frame.error_px.end()));
    }
    return fmt::format(
        "{} frames at {:g} Hz: p50 {:.2f} ms, p95 {:.2f} ms, p99 {:.2f} ms, max {:.2f} ms, {} missed; up to "
        "{} triangles, error up to {:.2f} px",
        frames.size(), rate_hz, summary.p50_ms, summary.p95_ms, summary.p99_ms, summary.max_ms,
        summary.missed, triangles, error_px);
}

lod::Result<lod::Ok> run_fly(const FlyArguments& arguments) {
    const auto scene = read_scene(arguments.scene);
    if (!scene) return scene.error();
    if (auto outputs = check_outputs(arguments); !outputs) return outputs.error();

    LoopOptions options = loop_options(arguments);
    WorldOptions building;
    building.tolerance_px = arguments.tolerance_px;
    building.glide_s = arguments.glide_s;
    building.batch = arguments.batch;
    building.threads = arguments.threads;
    building.reserve_triangles = reserve_for(options);
    building.trajectory = arguments.trajectory;
    building.waits_for_pages = arguments.operations.has_value();
    auto world = build_world(*scene, building);
    if (!world) return world.error();
    options.begin_s = arguments.time_s.value_or(scene->start.time_s.value_or(scene->time.begin_s));
    options.frames = frame_count(arguments, **world, options.begin_s);
    options.schedule = schedule_at_begin(arguments.schedule, options.begin_s);
    options.schedule_end_s = schedule_end_s(**world);

    const Optics optics{scene->start.fov_y_rad, arguments.size.width_px, arguments.size.height_px};
    auto stage =
        make_stage(std::move(*world), optics, {.has_window = arguments.window, .draws_frames = true});
    if (!stage) return stage.error();
    stage->world->ground_colours = {};  // the renderer has them
    const auto frames = run_loop(*stage, options, picture_taker(arguments));
    if (!frames) return frames.error();
    if (auto written = write_report(arguments, *stage, *frames); !written) return written.error();
    std::printf("%s\n", summary_line(arguments.rate_hz, *frames).c_str());
    return lod::Ok{};
}

}  // namespace sim
