// Routes on the ground: way points become key frames of something that drives, stops and turns.
#pragma once

#include <span>
#include <vector>

#include "data/scenes/scene_builder.h"

namespace data::site {

/// Drives along straight pieces, front (+y) ahead, turning within `turn_m` of each corner. The last position is
/// reached facing as driven.
struct Drive {
    double begins_s = 0.0;
    double speed_mps = 8.0;
    double turn_m = 4.0;  ///< less than half of every piece
};

/// Appends placements of a drive; `keys` may hold earlier ones.
/// @returns when it ends, s
double append_drive(std::span<const glm::dvec2> way, const Drive& drive, std::vector<KeyFrame>& keys);

/// The key frames of something fixed to a thing with these key frames.
std::vector<KeyFrame> carried(std::span<const KeyFrame> keys, const Placement& in_carrier);

}  // namespace data::site
