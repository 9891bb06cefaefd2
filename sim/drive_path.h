// DrivePath: a car along waypoints, on the source terrain itself, never on a level of detail.
#pragma once

#include "data/height_grid.h"
#include "lod/base/result.h"
#include "sim/eye_state.h"
#include "sim/plan_curve.h"

namespace sim {

struct DrivePath {
    PlanCurve curve;
    double speed_mps = 15.0;                   ///< > 0
    const data::HeightGrid* ground = nullptr;  ///< null: the waypoints' own heights are the ground
    data::WorldFrame frame;
};

/// The driver's eye above the ground.
inline constexpr double kDriverEye_m = 1.6;

/// The state at `time_s`: exactly kDriverEye_m above the source ground; pitch and roll from the ground's slope
/// along and across, averaged over half a second. CHECKs nothing: where the ground is unknown it is level.
EyeState state_at(const DrivePath& path, double time_s);

double duration_s(const DrivePath& path);

/// Fails when some place of the drive has no ground (outside the terrain, or on a hole), saying where.
lod::Result<lod::Ok> check_ground(const DrivePath& path);

}  // namespace sim
