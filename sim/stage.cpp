#include "sim/stage.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "lod/base/hash.h"
#include "sim/progress.h"
#include "sim/sunlight.h"

namespace sim {
namespace {

/// Feet of walls are lowered by this share of the ground's error bound: half of it leaves no more than half a bound
/// of air under a wall and hides no more than a bound and a half of it (tests/sim/monaco_test.cpp has figures).
constexpr double kFootShare = 0.5;

constexpr double kVisibility_m = 45000.0;

/// Shares out the pool; the regions follow each other.
render::PoolCapacity share_out(Stage& stage) {
    render::PoolCapacity pool;
    pool.commands = std::max<uint32_t>(1024, 2 * stage.world->item_count + 64);
    stage.regions.clear();
    for (lod::Front* front : stage.fronts) {
        lod::PoolRegion region = front->pool_need();
        region.first_vertex = pool.vertices;
        region.first_index = pool.indices;
        pool.vertices += region.vertex_capacity;
        pool.indices += region.index_capacity;
        front->place(region);
        stage.regions.push_back(region);
    }
    return pool;
}

bool has_outgrown(const Stage& stage) {
    for (size_t i = 0; i < stage.fronts.size(); ++i) {
        const lod::PoolRegion need = stage.fronts[i]->pool_need();
        const lod::PoolRegion& have = stage.regions[i];
        if (need.vertex_capacity > have.vertex_capacity || need.index_capacity > have.index_capacity)
            return true;
    }
    return false;
}

/// Rotation from the craft's eye frame to the head's.
glm::dmat3 head_from_craft(const HeadPose& head) {
    const double sy = std::sin(head.yaw_rad), cy = std::cos(head.yaw_rad);
    const double sp = std::sin(head.pitch_rad), cp = std::cos(head.pitch_rad);
    const glm::dvec3 ahead(sy * cp, sp, -cy * cp), right(cy, 0.0, sy);
    return glm::transpose(glm::dmat3(right, glm::cross(right, ahead), -ahead));
}

/// Needles to their signals, on models and on instruments; instruments to where the head sees them.
void move_needles(World& world, const Shot& shot) {
    if (!world.instruments && !world.panel && world.models_rig.moving.empty()) return;
    const Signals signals = signals_of(world, shot.state, shot.time_s);
    if (!world.models_rig.moving.empty()) {
        move_bodies(world.models_rig.moving, signals, world.models_rig.poses);
        pose_bodies(world.models_rig, glm::dmat3(1.0), glm::dvec3(0.0), *world.models);
    }
    const glm::dmat3 turn = head_from_craft(shot.head);
    move_bodies(world.cockpit.moving, signals, world.cockpit.poses);
    for (size_t body = 0; body < world.cockpit.poses.size(); ++body) {
        lod::BodyPose pose = world.cockpit.poses[body];
        pose.reference_from_body = turn * pose.reference_from_body;
        pose.origin = turn * (pose.origin - shot.head.position_m);
        world.instruments->set_pose(static_cast<uint32_t>(body), pose);
    }
    move_bodies(world.panel_rig.moving, signals, world.panel_rig.poses);
    if (world.panel) pose_bodies(world.panel_rig, turn, shot.head.position_m, *world.panel);
}

render::Atmosphere atmosphere_of(const World& world, const Shot& shot, const glm::dvec3& up_world) {
    render::Atmosphere air;
    air.sun_world = world.sun_world;
    air.up_world = up_world;
    air.visibility_m = kVisibility_m;
    air.eye_height_m =
        shot.state.site.height_m - (world.ground ? static_cast<double>(world.ground->min_m) : 0.0);
    if (world.ground) {
        const glm::dvec2 below = world.ground->frame.grid_from_site(shot.state.site);
        const glm::dvec2 last(world.ground->width - 1, world.ground->height - 1);
        air.ground_sample = glm::ivec2(glm::clamp(below, glm::dvec2(0.0), last)) * world.ground_stride;
    }
    return air;
}

/// Triangles of the cuts that adapt, or of those that do not.
uint64_t cut_triangles(const Stage& stage, bool adapts) {
    uint64_t sum = 0;
    for (const WorldFront& member : stage.members)
        sum += member.adapts == adapts ? member.front->triangles() : 0;
    return sum;
}

/// What glides away and is still drawn.
uint64_t leaving_triangles(const Stage& stage) {
    uint64_t sum = 0;
    for (const WorldFront& member : stage.members)
        sum += member.front->leaving_triangles();
    return sum;
}

/// The scheduler counts all fronts; what cannot adapt is given to it on top.
lod::Budget with_rigid(const Stage& stage, lod::Budget budget) {
    const uint64_t rigid = cut_triangles(stage, false);
    if (budget.max_triangles < UINT64_MAX - rigid) budget.max_triangles += rigid;
    return budget;
}

lod::OperationCounts all_operations(const Stage& stage) {
    lod::OperationCounts sum;
    for (const lod::Front* front : stage.fronts) {
        const lod::OperationCounts counts = front->operations();
        for (size_t i = 0; i < sum.count.size(); ++i)
            sum.count[i] += counts.count[i];
    }
    return sum;
}

void record_fronts(Stage& stage, FrameRecord& record) {
    for (const WorldFront& member : stage.members) {
        const auto module = static_cast<size_t>(member.module);
        record.triangles[module] += member.front->emitted_triangles();
        record.error_px[module] = std::max(record.error_px[module], member.front->error_px());
        record.jump_px = std::max(record.jump_px, member.front->jump_px());
        record.front_hash = lod::hash_combine(record.front_hash, member.front->hash());
    }
    const lod::OperationCounts now = all_operations(stage);
    for (size_t i = 0; i < now.count.size(); ++i) {
        record.operations.count[i] = now.count[i] - stage.operations_before.count[i];
    }
    stage.operations_before = now;
    record.drawn_triangles = cut_triangles(stage, true) + leaving_triangles(stage);
    record.draw_calls = stage.renderer.stats().draw_calls;
    record.commands = stage.renderer.stats().commands;
}

/// Fills the draw list, the cockpit first and the ground last: what stands in front is drawn before what it hides, which
/// is then not shaded. Makes the pool grow first when a front outgrew its region.
lod::Result<lod::Ok> emit_all(Stage& stage, const lod::View& view) {
    if (has_outgrown(stage)) {
        if (auto grown = stage.renderer.resize_pool(share_out(stage)); !grown) return grown.error();
    }
    stage.list.clear();
    for (auto front = stage.fronts.rbegin(); front != stage.fronts.rend(); ++front)
        (*front)->emit(view, stage.list);
    return lod::Ok{};
}

}  // namespace

lod::Result<Stage> make_stage(std::unique_ptr<World> world, const Optics& optics, const StageUse& use) {
    render::RendererOptions options;
    options.width_px = optics.width_px;
    options.height_px = optics.height_px;
    options.window = use.has_window;
    options.window_title = "Harrier: " + world->scene.name;
    options.pool = {1, 3, 16};  // until the fronts are placed
    auto renderer = render::Renderer::create(options);
    if (!renderer) return renderer.error();
    Stage stage{std::move(world), std::move(*renderer), optics, {}, {}, {}, {}, {}};
    stage.members = fronts_of(*stage.world);
    for (const WorldFront& member : stage.members)
        stage.fronts.push_back(member.front);
    const bool sifts = use.draws_frames && stage.renderer.is_software();
    for (const auto& site : stage.world->sites) {
        site->set_hiding(sifts ? objects::Hiding::kTriangles : objects::Hiding::kClusters,
                         std::max(std::thread::hardware_concurrency(), 1u));
    }
    if (auto pool = stage.renderer.resize_pool(share_out(stage)); !pool) return pool.error();
    stage.operations_before = all_operations(stage);
    const data::Image& colours = stage.world->ground_colours;
    if (colours.width > 0) {
        const data::HeightGrid& ground = *stage.world->ground;
        const int stride = stage.world->ground_stride;
        auto set =
            stage.renderer.set_ground_texture(colours.width, colours.height, colours.rgba,
                                              ground.width * stride, ground.height * stride, 0.5 * stride);
        if (!set) return set.error();
        stage.renderer.set_detail({ground.frame.cell_m() / double(stride), kSunEnu});
    }
    return stage;
}

void bring_relief_to(Stage& stage, double time_s) {
    World& world = *stage.world;
    const size_t before = world.relief.in_force;
    for (const TimedEdit* edit : bring_relief_to(world, time_s))
        stage.renderer.write_ground_texels(before < world.relief.in_force ? edit->colours
                                                                          : edit->colours_before);
}

lod::View view_of(const World& world, const Optics& optics, const EyeState& state, const HeadPose& head) {
    lod::View view;
    view.fov_y_rad = optics.fov_y_rad;
    view.width_px = optics.width_px;
    view.height_px = optics.height_px;
    view.near_m = optics.near_m;
    const glm::dvec3 craft_world = world.frame.world_from_site(state.site);
    const glm::dmat3 craft_from_world = lod::eye_from_attitude(
        world.frame.world_from_enu(craft_world), state.heading_rad, state.pitch_rad, state.roll_rad);
    view.eye_world = craft_world + glm::transpose(craft_from_world) * head.position_m;
    view.eye_from_world = head_from_craft(head) * craft_from_world;
    return view;
}

EyeState state_looking(const World& world, const glm::dvec3& eye_world, const glm::dvec3& target_world) {
    EyeState state;
    state.site = world.frame.site_from_world(eye_world);
    const glm::dvec3 way = glm::transpose(world.frame.world_from_enu(eye_world)) * (target_world - eye_world);
    const double level = std::hypot(way.x, way.y);
    state.heading_rad = level > 0.0 ? std::atan2(way.x, way.y) : 0.0;
    state.pitch_rad = std::atan2(way.z, level);
    return state;
}

lod::Result<FrameRecord> make_frame(Stage& stage, const Shot& shot, const Allowance& allowance) {
    World& world = *stage.world;
    FrameRecord record;
    record.frame = allowance.frame;
    record.time_s = shot.time_s;
    const Stopwatch total;

    bring_relief_to(stage, shot.schedule_s);
    const lod::View view = view_of(world, stage.optics, shot.state, shot.head);
    const glm::dvec3 up_world = world.frame.world_from_enu(view.eye_world)[2];
    move_needles(world, shot);
    for (const WorldFront& member : stage.members)
        member.front->begin_frame({&view, 1}, member.follows_schedule ? shot.schedule_s : shot.shown_s);
    record.update_ms = total.ms();

    const Stopwatch refine;
    const lod::ScheduleResult scheduled =
        lod::schedule(stage.fronts, with_rigid(stage, allowance.budget), allowance.deadline);
    record.converged = scheduled.converged;
    record.scheduled_operations = scheduled.operations;
    record.refine_ms = refine.ms();

    const Stopwatch emit;
    if (world.objects) {
        world.objects->set_up_world(up_world);
        world.objects->set_ground_error_px(world.terrain ? kFootShare * world.terrain->error_px() : 0.0);
    }
    if (auto emitted = emit_all(stage, view); !emitted) return emitted.error();
    record.emit_ms = emit.ms();

    const Stopwatch submit;
    stage.renderer.draw(view, stage.list, atmosphere_of(world, shot, up_world));
    record.submit_ms = submit.ms();
    const Stopwatch render;
    stage.renderer.finish();
    record.render_ms = render.ms();
    record.total_ms = total.ms();
    record_fronts(stage, record);
    return record;
}

}  // namespace sim
