// Eyepoint: one of the ways an eye moves through a scene, as a function of time alone.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "data/height_grid.h"
#include "lod/base/result.h"
#include "sim/drive_path.h"
#include "sim/eye_state.h"
#include "sim/flight_path.h"
#include "sim/recorded_path.h"
#include "sim/scene_file.h"

namespace sim {

/// The craft's way, and the ground it must stay above.
struct Eyepoint {
    std::variant<EyeState, FlightPath, DrivePath, RecordedPath> way;  ///< an EyeState stands still
    const data::HeightGrid* ground = nullptr;
};

/// No flight comes nearer to the source ground than this; the ground wins over the path.
inline constexpr double kGroundClearance_m = 2.0;

/// The pose at simulation time `time_s`, which is also the time of the path or recording. Deterministic, in any
/// order of times. A path below the source ground is lifted to kGroundClearance_m above it; a still eye is not.
EyeState pose_at(const Eyepoint& eyepoint, double time_s);

/// When the way ends, if it does.
std::optional<double> end_s(const Eyepoint& eyepoint);

/// Makes the eyepoint of a scene: its path, else its start camera, else a place south of the terrain's middle
/// that looks at it.
///
/// @param trajectory  a recording that replaces the scene's path; empty: none
/// @param ground      null without terrain; must outlive the eyepoint
/// @param notes       receives one line for each liberty taken (lifted fixes, a path beyond the terrain)
/// Fails on unreadable recordings, on coordinates that are none, and on a drive that leaves the terrain.
lod::Result<Eyepoint> make_eyepoint(const Scene& scene, const std::string& trajectory,
                                    const data::WorldFrame& frame, const data::HeightGrid* ground,
                                    std::vector<std::string>& notes);

}  // namespace sim
