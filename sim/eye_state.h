// EyeState: where the eye is and how it moves at one instant, in site coordinates.
#pragma once

#include "data/world_frame.h"

namespace sim {

/// Angles in radians: heading clockwise from north, pitch nose up, roll right wing down.
struct EyeState {
    data::SitePoint site;
    double heading_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
    double speed_mps = 0.0;           ///< along the path
    double vertical_speed_mps = 0.0;  ///< up
};

}  // namespace sim
