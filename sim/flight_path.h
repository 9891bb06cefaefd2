// FlightPath: an aeroplane along waypoints, turning as aeroplanes turn: banked, so that the ball stays centred.
#pragma once

#include "sim/eye_state.h"
#include "sim/plan_curve.h"

namespace sim {

struct FlightPath {
    PlanCurve curve;
    double speed_mps = 60.0;  ///< over ground, > 0
};

/// The state at `time_s`; the flight begins at time 0 and rests at its ends.
///
/// Bank is atan(v * omega / g) of the turn, at most 55 degrees; pitch is the climb. Both are averaged over 2 s,
/// so that a roll takes the time a roll takes. Continuous in time; nothing is remembered between calls.
EyeState state_at(const FlightPath& path, double time_s);

/// Seconds from the first waypoint to the last.
double duration_s(const FlightPath& path);

}  // namespace sim
