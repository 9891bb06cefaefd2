#include "sim/drive_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data/ground_height.h"
#include "sim/site_metres.h"
#include "sim/time_window.h"

namespace sim {
namespace {

constexpr double kSmoothing_s = 0.5;  // half width
constexpr double kHalfWheelbase_m = 1.4, kHalfTrack_m = 0.8;

data::GroundHeight ground_at(const DrivePath& path, const data::SitePoint& site) {
    return path.ground ? data::ground_height(*path.ground, site) : data::GroundHeight{site.height_m, true};
}

/// Rise from one side of the car to the other over the distance between; 0 where the ground is unknown.
double slope_between(const DrivePath& path, const data::SitePoint& site, glm::dvec2 half_step_m) {
    const data::GroundHeight from = ground_at(path, moved(path.frame, site, -half_step_m));
    const data::GroundHeight to = ground_at(path, moved(path.frame, site, half_step_m));
    if (!from.valid || !to.valid) return 0.0;
    return (to.height_m - from.height_m) / (2.0 * glm::length(half_step_m));
}

/// Slope ahead and slope to the left.
glm::dvec2 slopes_at(const DrivePath& path, double time_s) {
    const CurvePoint point = path.curve.at(time_s * path.speed_mps);
    if (!path.ground) return {point.climb, 0.0};
    const double s = std::sin(point.heading_rad), c = std::cos(point.heading_rad);
    return {slope_between(path, point.site, glm::dvec2(s, c) * kHalfWheelbase_m),
            slope_between(path, point.site, glm::dvec2(-c, s) * kHalfTrack_m)};
}

}  // namespace

double duration_s(const DrivePath& path) {
    return path.curve.length_m() / path.speed_mps;
}

EyeState state_at(const DrivePath& path, double time_s) {
    const CurvePoint here = path.curve.at(time_s * path.speed_mps);
    const glm::dvec2 slopes = smoothed(time_s, kSmoothing_s, [&](double t) { return slopes_at(path, t); });
    EyeState state;
    state.site = here.site;
    const data::GroundHeight ground = ground_at(path, here.site);
    if (ground.valid) state.site.height_m = ground.height_m;
    state.site.height_m += kDriverEye_m;
    state.heading_rad = here.heading_rad;
    state.pitch_rad = std::atan(slopes.x);
    state.roll_rad = std::atan(slopes.y);
    if (time_s >= 0.0 && time_s <= duration_s(path)) {
        state.speed_mps = path.speed_mps;
        state.vertical_speed_mps = path.speed_mps * slopes.x;
    }
    return state;
}

lod::Result<lod::Ok> check_ground(const DrivePath& path) {
    if (!path.ground) return lod::Ok{};
    const glm::dvec2 cell = path.ground->frame.cell_m();
    const double step_m = std::max(std::min(cell.x, cell.y) / 2.0, path.curve.length_m() / 1e5);
    for (double metres = 0.0;; metres += step_m) {
        const CurvePoint point = path.curve.at(metres);
        if (!ground_at(path, point.site).valid) {
            return lod::Error{
                fmt::format("path: no ground at {:.6f}, {:.6f}, {:.0f} m after the start, expected a "
                            "drive that stays on the terrain",
                            point.site.x, point.site.y, metres)};
        }
        if (metres >= path.curve.length_m()) return lod::Ok{};
    }
}

}  // namespace sim
