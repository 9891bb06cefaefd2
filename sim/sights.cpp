#include "sim/sights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/site_metres.h"

namespace sim {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

EyeState start_state(const World& world, double begin_s) {
    const StartPose& start = world.scene.start;
    if (!start.is_given) return pose_at(world.eyepoint, begin_s);
    return {start.site, start.heading_rad, start.pitch_rad, start.roll_rad};
}

/// The building nearest to the middle of all: the town's heart even when some stand far out.
glm::dvec3 town_world(const World& world) {
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& base : world.buildings)
        middle += base / static_cast<double>(world.buildings.size());
    return *std::min_element(world.buildings.begin(), world.buildings.end(),
                             [&](const glm::dvec3& a, const glm::dvec3& b) {
                                 return glm::distance(a, middle) < glm::distance(b, middle);
                             });
}

/// From the south, with the sun over the right shoulder, low enough that walls show.
EyeState town_state(const World& world) {
    const glm::dvec3 town = town_world(world);
    data::SitePoint site = moved(world.frame, world.frame.site_from_world(town), {120.0, -430.0});
    site.height_m =
        std::max(world.frame.site_from_world(town).height_m, ground_height_m(world, site)) + 130.0;
    return state_looking(world, world.frame.world_from_site(site), town);
}

/// The head leans towards the first instrument until that fills the picture.
HeadPose panel_head(const World& world) {
    const glm::dvec3 place = world.scene.instruments.front().position_eye_m;
    const double nearer = std::max(1.0 - 0.17 / std::max(glm::length(place), 1e-6), 0.0);
    HeadPose head;
    head.position_m = place * nearer + glm::dvec3(0.0, 0.015, 0.0);
    const glm::dvec3 way = place - head.position_m;
    head.yaw_rad = std::atan2(way.x, -way.z);
    head.pitch_rad = std::atan2(way.y, std::hypot(way.x, way.z));
    return head;
}

EyeState horizon_state(const World& world, double middle_s) {
    EyeState state = pose_at(world.eyepoint, middle_s);
    state.site.height_m += 450.0;
    state.pitch_rad = -3.0 * kRadPerDeg;
    state.roll_rad = 0.0;
    return state;
}

}  // namespace

std::vector<Sight> find_sights(const World& world, double middle_s) {
    std::vector<Sight> sights;
    const double begin_s = world.scene.start.time_s.value_or(world.scene.time.begin_s);
    sights.push_back({"ridge", "the scene's first view", {start_state(world, begin_s), {}, begin_s}});
    if (!world.buildings.empty())
        sights.push_back({"town", "buildings on the ground", {town_state(world), {}, begin_s}});
    if (!world.scene.instruments.empty()) {
        sights.push_back({"panel",
                          "an instrument from 17 cm",
                          {pose_at(world.eyepoint, middle_s), panel_head(world), middle_s}});
    }
    sights.push_back(
        {"horizon", "far sight from high above the path", {horizon_state(world, middle_s), {}, middle_s}});
    return sights;
}

}  // namespace sim
