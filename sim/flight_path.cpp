#include "sim/flight_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/time_window.h"

namespace sim {
namespace {

constexpr double kGravity_mps2 = 9.80665;
constexpr double kMaxBank_rad = 55.0 * std::numbers::pi / 180.0;
constexpr double kSmoothing_s = 2.0;  // half width

}  // namespace

double duration_s(const FlightPath& path) {
    return path.curve.length_m() / path.speed_mps;
}

EyeState state_at(const FlightPath& path, double time_s) {
    const double speed = path.speed_mps;
    const CurvePoint here = path.curve.at(time_s * speed);
    const glm::dvec2 attitude = smoothed(time_s, kSmoothing_s, [&](double t) {
        const CurvePoint there = path.curve.at(t * speed);
        const double bank = std::atan(speed * speed * there.curvature_right_per_m / kGravity_mps2);
        return glm::dvec2(std::clamp(bank, -kMaxBank_rad, kMaxBank_rad), std::atan(there.climb));
    });
    EyeState state;
    state.site = here.site;
    state.heading_rad = here.heading_rad;
    state.roll_rad = attitude.x;
    state.pitch_rad = attitude.y;
    if (time_s >= 0.0 && time_s <= duration_s(path)) {
        state.speed_mps = speed * std::sqrt(1.0 + here.climb * here.climb);
        state.vertical_speed_mps = speed * here.climb;
    }
    return state;
}

}  // namespace sim
