// The frame loop: the life of every frame, at a fixed rate.
//
//     clock.step ─► eyepoint or pilot ─► make_frame (stage.h) ─► report
//                                            ▲
//                    budget controller ──────┘  triangles from measured milliseconds; off in deterministic mode
//
// Two modes. Real time: frame n starts n periods after the first, refinement gets what the rest of the frame is
// expected to leave. Deterministic (`operations` given): the same number of operations in every frame, nobody
// looks at a clock to decide anything, nobody sleeps.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "lod/base/result.h"
#include "sim/budget_controller.h"
#include "sim/frame_report.h"
#include "sim/schedule.h"
#include "sim/stage.h"

namespace sim {

struct LoopOptions {
    int64_t frames = 600;         ///< at most this many
    double rate_hz = 60.0;        ///< in [0.001, 1,000,000]
    double begin_s = 0.0;         ///< simulation time of frame 0
    Schedule schedule;            ///< at frame 0
    double schedule_end_s = 0.0;  ///< where the key for the schedule's end leads
    double tolerance_px = 1.0;
    std::optional<uint64_t> triangles;   ///< limit of the adaptive fronts; without: the controller's
    std::optional<uint64_t> operations;  ///< per frame: the deterministic mode
};

/// Limits of the cut when the user gives none.
inline constexpr uint64_t kMostTriangles = 300000;          ///< the controller's upper end
inline constexpr uint64_t kDeterministicTriangles = 40000;  ///< in deterministic mode

/// What the loop's controller steers towards: the share of the period that is not for refinement, the rest of it for noise.
BudgetTarget budget_target(const LoopOptions& options);

/// Room to reserve in the terrain front so that a loop never grows its pool.
uint64_t reserve_for(const LoopOptions& options);

/// Called after each frame, outside its time; false ends the loop.
using AfterFrame = std::function<lod::Result<bool>(const FrameRecord&, Stage&)>;

/// Runs the loop; in real time after a few frames that warm caches, driver and controller and are not reported.
lod::Result<std::vector<FrameRecord>> run_loop(Stage& stage, const LoopOptions& options,
                                               const AfterFrame& after);

}  // namespace sim
