// Heading, pitch and roll of a craft from the path it flew.
#pragma once

#include <vector>

#include "data/motion_fix.h"

namespace data {

/// Attitude of one fix, radians.
struct Attitude {
    double heading_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
};

/// For every fix: heading along the ground track (the nearest one in time where it stands still, below 1 m/s), pitch
/// along the climb, at most 30 degrees, roll of a coordinated turn, atan(speed * turn rate / g), at most 60 degrees.
/// Pitch and roll fade in from 1 to 5 m/s, where jitter would rule. Smoothed over 1.5 s, so that steps of a second do not tremble and longer ones are not blurred.
/// @param recorded  at least two fixes
std::vector<Attitude> derive_attitude(const MotionFixes& recorded);

}  // namespace data
