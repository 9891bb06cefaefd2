#include "sim/command_still.h"

#include <cstdio>
#include <numbers>

#include "sim/depth_tiff.h"
#include "sim/ply_writer.h"
#include "sim/stage.h"
#include "sim/whole_file.h"

namespace sim {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr uint64_t kEnoughOperations = 4'000'000'000;  // far beyond any front; the loop ends by converging

/// At a triangle limit fronts may swap for ever without gain: an end after which a picture is as good as it gets.
uint64_t most_operations(const StillArguments& arguments) {
    if (arguments.operations) return *arguments.operations;
    return arguments.triangles ? 20 * *arguments.triangles + 20000 : kEnoughOperations;
}

double still_time_s(const StillArguments& arguments, const Scene& scene) {
    return arguments.time_s.value_or(scene.start.time_s.value_or(scene.time.begin_s));
}

/// The camera of the command line; else the path at a time asked for; else the start camera; else the path.
EyeState still_state(const StillArguments& arguments, const World& world, double time_s) {
    if (arguments.camera.size() == 6) {
        const std::vector<double>& c = arguments.camera;
        return {{c[0], c[1], c[2]}, c[3] * kRadPerDeg, c[4] * kRadPerDeg, c[5] * kRadPerDeg};
    }
    if (arguments.eye.size() == 3) {
        const std::vector<double>&e = arguments.eye, &t = arguments.target;
        return state_looking(world, {e[0], e[1], e[2]}, {t[0], t[1], t[2]});
    }
    const StartPose& start = world.scene.start;
    const bool is_timed = arguments.time_s && world.scene.path;
    if (start.is_given && !is_timed) return {start.site, start.heading_rad, start.pitch_rad, start.roll_rad};
    return pose_at(world.eyepoint, time_s);
}

lod::Result<lod::Ok> check_outputs(const StillArguments& arguments) {
    for (const std::string& path : {arguments.image, arguments.depth, arguments.geometry}) {
        if (path.empty()) continue;
        if (auto writable = check_writable(path); !writable) return writable.error();
    }
    return lod::Ok{};
}

lod::Result<lod::Ok> write_outputs(const StillArguments& arguments, Stage& stage, const lod::View& view) {
    if (!arguments.image.empty()) {
        auto written = render::write_png(arguments.image, stage.renderer.read_colour());
        if (!written) return written.error();
    }
    if (!arguments.depth.empty()) {
        auto written = write_depth_tiff(arguments.depth, stage.renderer.read_depth());
        if (!written) return written.error();
    }
    if (!arguments.geometry.empty()) {
        auto written = write_ply(arguments.geometry, merge_corners(stage.renderer.read_triangles(view)));
        if (!written) return written.error();
    }
    return lod::Ok{};
}

Allowance still_allowance(const StillArguments& arguments) {
    Allowance allowance;
    allowance.budget.tolerance_px = arguments.tolerance_px;
    if (arguments.triangles) allowance.budget.max_triangles = *arguments.triangles;
    allowance.deadline = lod::operation_limit(most_operations(arguments));
    return allowance;
}

}  // namespace

void add_still(CLI::App& app, StillArguments& arguments) {
    app.add_option("scene", arguments.scene, "scene file (TOML)")->required()->type_name("SCENE");
    CLI::Option* camera =
        add_numbers(app, "--camera", arguments.camera, 6,
                    "longitude and latitude in degrees (or x, y), height in m, heading, pitch and roll "
                    "in degrees; default: the scene's start");
    camera->type_name("LON,LAT,HEIGHT,HEADING,PITCH,ROLL");
    CLI::Option* eye =
        add_numbers(app, "--eye", arguments.eye, 3, "camera in world coordinates, m (ECEF, or x, y, height)");
    CLI::Option* target =
        add_numbers(app, "--target", arguments.target, 3, "where --eye looks, world coordinates, m");
    eye->type_name("X,Y,Z")->needs(target)->excludes(camera);
    target->type_name("X,Y,Z")->needs(eye);
    app.add_option("--fov", arguments.fov_deg, "vertical field of view, degrees; default: the scene's")
        ->check(CLI::Range(0.01, 170.0))
        ->type_name("DEG");
    app.add_option("--time", arguments.time_s,
                   "simulation time, s; also where on the path when no camera is given")
        ->check(CLI::Range(-1e9, 4e9))
        ->type_name("T");
    app.add_option("--tolerance", arguments.tolerance_px,
                   "screen error to reach, pixels; 0: the source data itself")
        ->check(CLI::Range(0.0, 1e6))
        ->type_name("PX")
        ->capture_default_str();
    add_size(app, arguments.size);
    app.add_option("--triangles", arguments.triangles,
                   "most triangles of geometry that adapts; default: no limit")
        ->check(CLI::Range(uint64_t{2}, uint64_t{1'000'000'000}))
        ->type_name("N");
    app.add_option("--ops", arguments.operations, "stop after this many operations; default: when converged")
        ->type_name("N");
    add_batch(app, arguments.batch);
    add_threads(app, arguments.threads);
    app.add_option("--image", arguments.image, "write the picture, PNG")->type_name("F.png");
    app.add_option("--depth", arguments.depth, "write metres along the line of sight, float GeoTIFF")
        ->type_name("F.tif");
    app.add_option("--geometry", arguments.geometry, "write every drawn triangle in world coordinates, PLY")
        ->type_name("F.ply");
}

lod::Result<lod::Ok> run_still(const StillArguments& arguments) {
    const auto scene = read_scene(arguments.scene);
    if (!scene) return scene.error();
    if (auto outputs = check_outputs(arguments); !outputs) return outputs.error();
    WorldOptions building;
    building.tolerance_px = arguments.tolerance_px;
    building.batch = arguments.batch;
    building.threads = arguments.threads;
    building.has_picture = !arguments.image.empty();
    building.waits_for_pages = true;
    auto world = build_world(*scene, building);
    if (!world) return world.error();

    const double fov_rad = arguments.fov_deg ? *arguments.fov_deg * kRadPerDeg : scene->start.fov_y_rad;
    const Optics optics{fov_rad, arguments.size.width_px, arguments.size.height_px};
    auto stage = make_stage(std::move(*world), optics, {});
    if (!stage) return stage.error();
    Shot shot;
    shot.time_s = shot.schedule_s = shot.shown_s = still_time_s(arguments, *scene);
    bring_relief_to(*stage, shot.schedule_s);
    shot.state = still_state(arguments, *stage->world, shot.time_s);
    const auto record = make_frame(*stage, shot, still_allowance(arguments));
    if (!record) return record.error();
    const lod::View view = view_of(*stage->world, optics, shot.state, shot.head);
    if (auto written = write_outputs(arguments, *stage, view); !written) return written.error();

    const nlohmann::json json = {{"triangles", by_module(record->triangles)},
                                 {"error_px", by_module(record->error_px)},
                                 {"converged", record->converged},
                                 {"operations", record->scheduled_operations},
                                 {"renderer", stage->renderer.device()}};
    std::printf("%s\n", json.dump().c_str());
    return lod::Ok{};
}

}  // namespace sim
