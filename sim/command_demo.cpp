#include "sim/command_demo.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "sim/command_fly.h"
#include "sim/command_values.h"
#include "sim/frame_loop.h"
#include "sim/progress.h"
#include "sim/sights.h"
#include "sim/whole_file.h"

namespace sim {
namespace {

namespace fs = std::filesystem;

constexpr double kFlight_s = 10.0, kRate_hz = 30.0, kTolerance_px = 1.0;
constexpr Optics kFlightOptics{1.0471975511965976, 640, 360};
constexpr Optics kStillOptics{1.0471975511965976, 1280, 720};

/// Beside the sources it was built from, or where an installation puts it.
lod::Result<std::string> bundled_scene() {
    std::error_code problem;
    const fs::path program = fs::read_symlink("/proc/self/exe", problem).parent_path();
    for (const char* place : {"../../data/samples", "../share/harrier/samples"}) {
        const fs::path scene = (program / place / "jacksboro.toml").lexically_normal();
        if (fs::exists(scene, problem)) return scene.string();
    }
    return lod::Error{
        "data/samples/jacksboro.toml: not found near the program, expected the bundled scene or --scene "
        "FILE"};
}

struct Flight {
    std::vector<FrameRecord> frames;
    RunFacts facts;
    double begin_s = 0.0;
};

lod::Result<Flight> fly(Stage& stage, const std::string& scene, const ScheduleArguments& schedule) {
    LoopOptions options;
    options.rate_hz = kRate_hz;
    options.frames = static_cast<int64_t>(kFlight_s * kRate_hz);
    options.begin_s = stage.world->scene.start.time_s.value_or(stage.world->scene.time.begin_s);
    options.schedule = schedule_at_begin(schedule, options.begin_s);
    options.schedule_end_s = schedule_end_s(*stage.world);
    options.tolerance_px = kTolerance_px;
    say_progress(fmt::format("flying {} s at {} Hz, {} x {} pixels", kFlight_s, kRate_hz,
                             stage.optics.width_px, stage.optics.height_px));
    auto frames =
        run_loop(stage, options, [](const FrameRecord&, Stage&) -> lod::Result<bool> { return true; });
    if (!frames) return frames.error();
    Flight flight{std::move(*frames), {}, options.begin_s};
    flight.facts = {
        scene,        kRate_hz, stage.optics.width_px, stage.optics.height_px, stage.renderer.device(),
        resident_mb()};
    return flight;
}

/// One converged picture a sight; returns a line about each.
/// @param middle_s  of the flight; @param seek_s what the schedule is at then
lod::Result<std::string> take_pictures(Stage& stage, const fs::path& out, double middle_s, double seek_s) {
    std::string lines;
    bring_relief_to(stage, seek_s);
    for (Sight& sight : find_sights(*stage.world, middle_s)) {
        sight.shot.schedule_s = seek_s;
        Allowance allowance;
        allowance.budget.tolerance_px = kTolerance_px;
        allowance.deadline = lod::operation_limit(UINT64_MAX);
        const auto record = make_frame(stage, sight.shot, allowance);
        if (!record) return record.error();
        const std::string file = (out / (sight.name + ".png")).string();
        if (auto written = render::write_png(file, stage.renderer.read_colour()); !written)
            return written.error();
        lines += fmt::format("  {}  {}: {} + {} + {} triangles, error {:.2f} px, {} draw call\n", file,
                             sight.caption, record->triangles[0], record->triangles[1], record->triangles[2],
                             record->error_px[0], record->draw_calls);
    }
    return lines;
}

std::string summary_of(const Flight& flight, const std::string& pictures, const fs::path& out) {
    const FrameRecord& last = flight.frames.back();
    return fmt::format(
        "{}\n{}, {} x {} pixels, resident {:.0f} MB\n{}\n"
        "last frame: {} terrain, {} objects, {} instruments triangles; {} draw call with {} commands\n"
        "pictures, {} x {} pixels, converged to {} px:\n{}frames: {}\n",
        flight.facts.scene, flight.facts.renderer, flight.facts.width_px, flight.facts.height_px,
        flight.facts.rss_mb, summary_line(kRate_hz, flight.frames), last.triangles[0], last.triangles[1],
        last.triangles[2], last.draw_calls, last.commands, kStillOptics.width_px, kStillOptics.height_px,
        kTolerance_px, pictures, (out / "report.json").string());
}

}  // namespace

void add_demo(CLI::App& app, DemoArguments& arguments) {
    app.add_option("--scene", arguments.scene, "another scene file (TOML); default: the bundled one")
        ->type_name("SCENE");
    app.add_option("--out", arguments.out, "folder for report and pictures")
        ->type_name("DIR")
        ->capture_default_str();
    add_schedule(app, arguments.schedule);
    add_batch(app, arguments.batch);
    add_threads(app, arguments.threads);
}

lod::Result<lod::Ok> run_demo(const DemoArguments& arguments) {
    const auto file = arguments.scene.empty() ? bundled_scene() : lod::Result<std::string>(arguments.scene);
    if (!file) return file.error();
    const auto scene = read_scene(*file);
    if (!scene) return scene.error();
    if (auto folder = make_folder(arguments.out); !folder) return folder.error();
    WorldOptions building;
    building.tolerance_px = kTolerance_px;
    building.batch = arguments.batch;
    building.threads = arguments.threads;
    building.reserve_triangles = reserve_for({});
    auto world = build_world(*scene, building);
    if (!world) return world.error();

    std::unique_ptr<World> flown;
    lod::Result<Flight> flight = lod::Error{};
    {
        auto stage = make_stage(std::move(*world), kFlightOptics, {.draws_frames = true});
        if (!stage) return stage.error();
        flight = fly(*stage, *file, arguments.schedule);
        flown = std::move(stage->world);
    }  // one renderer at a time
    if (!flight) return flight.error();
    auto stage = make_stage(std::move(flown), kStillOptics, {});
    if (!stage) return stage.error();
    const fs::path out(arguments.out);
    const double seek_s = schedule_s(schedule_at_begin(arguments.schedule, flight->begin_s),
                                     static_cast<int64_t>(kFlight_s / 2.0 * 1e9));
    const auto pictures = take_pictures(*stage, out, flight->begin_s + kFlight_s / 2.0, seek_s);
    if (!pictures) return pictures.error();

    const std::string summary = summary_of(*flight, *pictures, out);
    auto report =
        write_whole((out / "report.json").string(), to_json(flight->facts, flight->frames).dump(1) + "\n");
    if (!report) return report.error();
    if (auto text = write_whole((out / "summary.txt").string(), summary); !text) return text.error();
    std::printf("%s", summary.c_str());
    return lod::Ok{};
}

}  // namespace sim
