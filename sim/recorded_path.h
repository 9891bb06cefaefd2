// RecordedPath: a recording played back; fixes that lie below the ground (barometric heights) are lifted.
#pragma once

#include <cstdint>

#include "data/height_grid.h"
#include "data/motion.h"
#include "sim/eye_state.h"

namespace sim {

struct RecordedPath {
    data::Motion motion;
    data::WorldFrame frame;
};

/// The state at `time_s` of the recording's own clock, clamped to its ends. Speeds by differences over 1 s.
EyeState state_at(const RecordedPath& path, double time_s);

/// Lifts every fix to at least `clearance_m` above the source ground. @returns how many were lifted
uint64_t lift_fixes(data::Motion& motion, const data::HeightGrid& ground, double clearance_m);

}  // namespace sim
