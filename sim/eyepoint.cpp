#include "sim/eyepoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "data/ground_height.h"
#include "sim/site_metres.h"

namespace sim {
namespace {

EyeState state_at(const EyeState& state, double) {
    return state;
}

data::GroundHeight ground_below(const data::HeightGrid* ground, const data::SitePoint& site) {
    return ground ? data::ground_height(*ground, site) : data::GroundHeight{};
}

bool is_place(const data::WorldFrame& frame, const data::SitePoint& site) {
    return !frame.has_datum || (std::abs(site.x) <= 360.0 && std::abs(site.y) <= 90.0);
}

lod::Result<lod::Ok> check_places(const Scene& scene, const data::WorldFrame& frame) {
    const auto refuse = [&](const char* what, const data::SitePoint& site) {
        return lod::Error{
            fmt::format("{}: {} at {}, {} is no place, expected longitude and latitude in degrees",
                        scene.file, what, site.x, site.y)};
    };
    if (!is_place(frame, scene.start.site)) return refuse("the start camera", scene.start.site);
    if (scene.path) {
        for (const data::SitePoint& point : scene.path->waypoints) {
            if (!is_place(frame, point)) return refuse("a waypoint", point);
        }
    }
    return lod::Ok{};
}

/// Looks north at the terrain's middle from a place a third of the way to its southern edge.
EyeState default_state(const data::HeightGrid* ground) {
    EyeState state;
    if (!ground) return state;
    const double middle = (ground->width - 1) / 2.0;
    state.site = ground->frame.site_from_grid(middle, (ground->height - 1) * 0.8);
    const double relief_m = static_cast<double>(ground->max_m) - static_cast<double>(ground->min_m);
    state.site.height_m = static_cast<double>(ground->max_m) + std::max(0.25 * relief_m, 100.0);
    state.pitch_rad = -8.0 * std::numbers::pi / 180.0;
    return state;
}

lod::Result<Eyepoint> make_recorded(const std::string& file, const data::WorldFrame& frame,
                                    const data::HeightGrid* ground, std::vector<std::string>& notes) {
    lod::Result<data::Motion> motion = data::read_motion(file);
    if (!motion) return motion.error();
    if (motion->dropped > 0) {
        notes.push_back(fmt::format("{}: {} of {} rows are no fixes (no place, repeated or cut), left out",
                                    file, motion->dropped, motion->dropped + motion->samples.size()));
    }
    if (ground) {
        const uint64_t lifted = lift_fixes(*motion, *ground, kGroundClearance_m);
        if (lifted > 0) {
            notes.push_back(fmt::format("{}: {} of {} fixes lay below the ground, lifted to {} m above it",
                                        file, lifted, motion->samples.size(), kGroundClearance_m));
        }
    }
    return Eyepoint{RecordedPath{std::move(*motion), frame}, ground};
}

/// Says so when the way is lifted over the ground or leaves the terrain; 1,000 places are tried.
void note_ground(const Eyepoint& eyepoint, std::vector<std::string>& notes) {
    const std::optional<double> end = end_s(eyepoint);
    if (!eyepoint.ground || !end) return;
    constexpr int kPlaces = 1000;
    int outside = 0, below = 0;
    for (int i = 0; i <= kPlaces; ++i) {
        const double time = *end * i / kPlaces;
        const EyeState state = std::visit([&](const auto& way) { return state_at(way, time); }, eyepoint.way);
        const data::GroundHeight ground = ground_below(eyepoint.ground, state.site);
        outside += !ground.valid;
        below += ground.valid && state.site.height_m < ground.height_m + kGroundClearance_m - 0.5;
    }
    if (below > 0) {
        notes.push_back(
            fmt::format("path: {:.1f} % of it lies below the ground or close to it, flown {} m above",
                        100.0 * below / (kPlaces + 1), kGroundClearance_m));
    }
    if (outside > 0) {
        notes.push_back(
            fmt::format("path: {:.1f} % of it lies outside the terrain, nothing is below it there",
                        100.0 * outside / (kPlaces + 1)));
    }
}

lod::Result<Eyepoint> make_way(const Scene& scene, const std::string& trajectory,
                               const data::WorldFrame& frame, const data::HeightGrid* ground,
                               std::vector<std::string>& notes) {
    if (!trajectory.empty()) return make_recorded(trajectory, frame, ground, notes);
    if (!scene.path) {
        EyeState still = default_state(ground);
        if (scene.start.is_given) {
            still = {scene.start.site, scene.start.heading_rad, scene.start.pitch_rad, scene.start.roll_rad};
        }
        return Eyepoint{still, ground};
    }
    const PathSource& path = *scene.path;
    if (path.kind == PathSource::Kind::kRecorded) return make_recorded(path.source, frame, ground, notes);
    if (path.kind == PathSource::Kind::kFlight) {
        return Eyepoint{FlightPath{PlanCurve(path.waypoints, frame), path.speed_mps}, ground};
    }
    DrivePath drive{PlanCurve(path.waypoints, frame), path.speed_mps, ground, frame};
    if (lod::Result<lod::Ok> checked = check_ground(drive); !checked) {
        return lod::Error{scene.file + ": " + checked.message()};
    }
    return Eyepoint{std::move(drive), ground};
}

}  // namespace

EyeState pose_at(const Eyepoint& eyepoint, double time_s) {
    EyeState state = std::visit([&](const auto& way) { return state_at(way, time_s); }, eyepoint.way);
    const bool may_sink = std::holds_alternative<FlightPath>(eyepoint.way) ||
                          std::holds_alternative<RecordedPath>(eyepoint.way);
    if (!may_sink) return state;
    const data::GroundHeight ground = ground_below(eyepoint.ground, state.site);
    if (ground.valid)
        state.site.height_m = std::max(state.site.height_m, ground.height_m + kGroundClearance_m);
    return state;
}

std::optional<double> end_s(const Eyepoint& eyepoint) {
    if (const auto* flight = std::get_if<FlightPath>(&eyepoint.way)) return duration_s(*flight);
    if (const auto* drive = std::get_if<DrivePath>(&eyepoint.way)) return duration_s(*drive);
    if (const auto* recorded = std::get_if<RecordedPath>(&eyepoint.way)) return recorded->motion.duration_s();
    return std::nullopt;
}

lod::Result<Eyepoint> make_eyepoint(const Scene& scene, const std::string& trajectory,
                                    const data::WorldFrame& frame, const data::HeightGrid* ground,
                                    std::vector<std::string>& notes) {
    if (lod::Result<lod::Ok> places = check_places(scene, frame); !places) return places.error();
    lod::Result<Eyepoint> eyepoint = make_way(scene, trajectory, frame, ground, notes);
    if (eyepoint) note_ground(*eyepoint, notes);
    return eyepoint;
}

}  // namespace sim
