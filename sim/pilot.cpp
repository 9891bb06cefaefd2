#include "sim/pilot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "data/ground_height.h"
#include "sim/site_metres.h"

namespace sim {
namespace {

constexpr double kTurn_radps = std::numbers::pi / 3.0;
constexpr double kMaxPitch_rad = 85.0 * std::numbers::pi / 180.0;
constexpr double kSpeedStep = 1.03;  // per frame with the key held

bool is_touched(const render::Renderer::Input& input) {
    return input.forward != 0 || input.right != 0 || input.up != 0 || input.yaw != 0 || input.pitch != 0 ||
           input.roll != 0;
}

void move(EyeState& state, const World& world, const glm::dvec3& enu_m) {
    const double height_m = state.site.height_m + enu_m.z;
    state.site = moved(world.frame, state.site, glm::dvec2(enu_m));
    state.site.height_m = height_m;
    if (!world.ground) return;
    const data::GroundHeight ground = data::ground_height(*world.ground, state.site);
    if (ground.valid) state.site.height_m = std::max(height_m, ground.height_m + kGroundClearance_m);
}

}  // namespace

void steer(Pilot& pilot, const render::Renderer::Input& input, const World& world, const EyeState& path_state,
           double step_s) {
    pilot.is_closing |= input.close;
    if (input.pause) pilot.is_paused = !pilot.is_paused;
    if (!pilot.is_free && is_touched(input)) {
        pilot.is_free = true;
        pilot.state = path_state;
        pilot.speed_mps = std::max(path_state.speed_mps, 30.0);
    }
    if (!pilot.is_free) return;
    if (input.faster) pilot.speed_mps = std::min(pilot.speed_mps * kSpeedStep, 5000.0);
    if (input.slower) pilot.speed_mps = std::max(pilot.speed_mps / kSpeedStep, 1.0);

    EyeState& state = pilot.state;
    const double turn_rad = kTurn_radps * step_s;
    state.heading_rad = std::remainder(state.heading_rad + input.yaw * turn_rad, 2.0 * std::numbers::pi);
    state.pitch_rad = std::clamp(state.pitch_rad + input.pitch * turn_rad, -kMaxPitch_rad, kMaxPitch_rad);
    state.roll_rad = std::remainder(state.roll_rad + input.roll * turn_rad, 2.0 * std::numbers::pi);

    const double sh = std::sin(state.heading_rad), ch = std::cos(state.heading_rad);
    const double sp = std::sin(state.pitch_rad), cp = std::cos(state.pitch_rad);
    const double way_m = pilot.speed_mps * step_s;
    const glm::dvec3 ahead(sh * cp, ch * cp, sp), right(ch, -sh, 0.0), up(0.0, 0.0, 1.0);
    move(state, world, (ahead * input.forward + right * input.right + up * input.up) * way_m);
    state.speed_mps = std::abs(input.forward) * pilot.speed_mps;
    state.vertical_speed_mps = (sp * input.forward + input.up) * pilot.speed_mps;
}

}  // namespace sim
