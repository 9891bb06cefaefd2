// Pilot: free flight by keys and mouse, once somebody touches them.
#pragma once

#include "render/renderer.h"
#include "sim/eye_state.h"
#include "sim/world.h"

namespace sim {

struct Pilot {
    bool is_free = false;  ///< false: the scene's path flies
    bool is_paused = false;
    bool is_closing = false;  ///< the window was closed
    EyeState state;           ///< while free
    double speed_mps = 60.0;  ///< of full forward, sideways or upward input
};

/// Takes one step's input. The first touch takes over at `path_state`. Turning is at most 60 degrees a second;
/// the eye stays above the source ground.
/// @param step_s  simulation time since the last call
void steer(Pilot& pilot, const render::Renderer::Input& input, const World& world, const EyeState& path_state,
           double step_s);

}  // namespace sim
