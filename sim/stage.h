// Stage: a world before a renderer, and the one function that makes a frame of it.
//
//     pose, head ─► View ─► begin_frame of each front ─► schedule ─► emit of each ─► draw ─► finish
//
// The geometry pool is shared out once: each front gets its region; only a front that outgrew its region makes the
// pool grow (counted as an allocation by the renderer).
#pragma once

#include <memory>
#include <vector>

#include "lod/base/result.h"
#include "lod/scheduler.h"
#include "render/renderer.h"
#include "sim/frame_report.h"
#include "sim/world.h"

namespace sim {

/// The picture's optics.
struct Optics {
    double fov_y_rad = 1.0471975511965976;
    int width_px = 640, height_px = 360;
    double near_m = 0.1;
};

/// Where the pilot's head is in the cockpit; at rest it is the eye the instruments are placed for.
struct HeadPose {
    glm::dvec3 position_m{0.0};  ///< eye frame of the craft: +x right, +y up, -z ahead
    double yaw_rad = 0.0;        ///< right
    double pitch_rad = 0.0;      ///< up
};

/// What one frame shows.
struct Shot {
    EyeState state;
    HeadPose head;
    double time_s = 0.0;      ///< of the flight: signals
    double schedule_s = 0.0;  ///< of what appears, disappears and moves (schedule.h)
    double shown_s = 0.0;     ///< as whoever looks on has passed it: what glides, glides in it
};

/// What it may spend.
struct Allowance {
    lod::Budget budget;  ///< max_triangles: of the adaptive fronts
    lod::Deadline deadline;
    int64_t frame = 0;
};

struct Stage {
    std::unique_ptr<World> world;
    render::Renderer renderer;
    Optics optics;
    std::vector<WorldFront> members;  ///< the world's fronts
    std::vector<lod::Front*> fronts;  ///< [members], as the scheduler takes them
    lod::DrawList list;
    std::vector<lod::PoolRegion> regions;  ///< [members]
    lod::OperationCounts operations_before;
};

/// What a stage is for.
struct StageUse {
    bool has_window = false;
    bool draws_frames = false;  ///< time counts: what no pixel shows is left out where that saves some
};

/// Makes the renderer with a pool that holds what the fronts say they need now, and hands it the ground's colours.
lod::Result<Stage> make_stage(std::unique_ptr<World> world, const Optics& optics, const StageUse& use);

/// The world's ground at a time, and the renderer's colours of it. make_frame does this itself; whoever asks the
/// ground before, as paths over it do, does it first.
void bring_relief_to(Stage& stage, double time_s);

/// The view of a state of flight with a moved head.
lod::View view_of(const World& world, const Optics& optics, const EyeState& state, const HeadPose& head);

/// The state of flight whose view looks from one place to another, horizon level; world coordinates.
EyeState state_looking(const World& world, const glm::dvec3& eye_world, const glm::dvec3& target_world);

/// One frame from pose to complete picture, timed. Fails only when a grown pool cannot be had.
lod::Result<FrameRecord> make_frame(Stage& stage, const Shot& shot, const Allowance& allowance);

}  // namespace sim
