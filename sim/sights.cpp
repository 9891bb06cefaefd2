#include "sim/sights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/site_metres.h"
#include "sim/sunlight.h"

namespace sim {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// Before the panel, so that nothing but the land is seen.
constexpr HeadPose kOutside{{0.0, 0.0, -2.0}, 0.0, 0.0};

/// The brink of a high flank in the sun with level land before it, and where to look at it from.
struct Brink {
    glm::ivec2 sample{0}, eye{0};  ///< columns and rows; the eye may lie outside the terrain
    double drop_m = 0.0;           ///< from the brink to the highest ground at its foot and up to the eye
};

/// Samples between two places, as a step of columns and rows. @param bearing_rad  clockwise from north
glm::ivec2 cells(const data::HeightGrid& ground, double bearing_rad, double metres) {
    const glm::dvec2 way_m = glm::dvec2(std::sin(bearing_rad), -std::cos(bearing_rad)) * metres;
    return glm::ivec2(glm::round(way_m / ground.frame.cell_m()));
}

double height_near_m(const data::HeightGrid& ground, const glm::ivec2& sample) {
    const glm::ivec2 inside =
        glm::clamp(sample, glm::ivec2(0), glm::ivec2(ground.width - 1, ground.height - 1));
    return static_cast<double>(ground.at(inside.x, inside.y));
}

/// Searches the middle half of the terrain.
Brink find_brink(const data::HeightGrid& ground) {
    const double sun_rad = std::atan2(kSunEnu.x, kSunEnu.y);
    const glm::ivec2 foot = cells(ground, sun_rad, 2000.0);
    const glm::ivec2 eye = cells(ground, sun_rad + 45.0 * kRadPerDeg, 5500.0);
    Brink brink;
    double best_m = -1e9;
    for (int row = ground.height / 4; row <= ground.height * 3 / 4; ++row) {
        for (int col = ground.width / 4; col <= ground.width * 3 / 4; ++col) {
            const glm::ivec2 here(col, row);
            double highest_m = height_near_m(ground, here + foot), lowest_m = highest_m;
            for (int part = 3; part <= 8; ++part) {
                const double there_m = height_near_m(ground, here + eye * part / 8);
                highest_m = std::max(highest_m, there_m);
                lowest_m = std::min(lowest_m, there_m);
            }
            const double drop_m = height_near_m(ground, here) - highest_m;
            const double score_m = drop_m - 1.5 * (highest_m - lowest_m);
            if (score_m > best_m) {
                best_m = score_m;
                brink = {here, here + eye, drop_m};
            }
        }
    }
    brink.sample = glm::clamp(brink.sample, glm::ivec2(0), glm::ivec2(ground.width - 1, ground.height - 1));
    return brink;
}

/// Looks at the sunny flank from the air before it, a little from above.
EyeState ridge_state(const World& world, double begin_s) {
    if (!world.ground) return pose_at(world.eyepoint, begin_s);
    const data::HeightGrid& ground = *world.ground;
    const Brink brink = find_brink(ground);
    data::SitePoint top = ground.frame.site_from_grid(brink.sample.x, brink.sample.y);
    top.height_m = static_cast<double>(ground.at(brink.sample.x, brink.sample.y));
    data::SitePoint eye = ground.frame.site_from_grid(brink.eye.x, brink.eye.y);
    eye.height_m = std::max(top.height_m + 0.3 * brink.drop_m, ground_height_m(world, eye) + 60.0);
    top.height_m -= 0.7 * brink.drop_m;
    return state_looking(world, world.frame.world_from_site(eye), world.frame.world_from_site(top));
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

/// Straight before the instrument in the middle of the panel, from reading distance.
HeadPose panel_head(const World& world) {
    const auto& instruments = world.scene.instruments;
    glm::dvec3 middle(0.0);
    for (const InstrumentSource& instrument : instruments) {
        middle += instrument.position_eye_m / static_cast<double>(instruments.size());
    }
    return {middle + glm::dvec3(0.0, 0.035, 0.20), 0.0, -0.17};
}

/// On the path, but heading away from the sun, so that it shines on the panel.
EyeState panel_state(const World& world, double middle_s) {
    EyeState state = pose_at(world.eyepoint, middle_s);
    state.heading_rad = std::atan2(-kSunEnu.x, -kSunEnu.y) - 30.0 * kRadPerDeg;
    return state;
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
    sights.push_back(
        {"ridge", "a mountain side in the sun", {ridge_state(world, begin_s), kOutside, begin_s}});
    if (!world.buildings.empty())
        sights.push_back({"town", "buildings on the ground", {town_state(world), {}, begin_s}});
    if (!world.scene.instruments.empty()) {
        sights.push_back(
            {"panel", "instruments from 20 cm", {panel_state(world, middle_s), panel_head(world), middle_s}});
    }
    sights.push_back(
        {"horizon", "far sight from high above the path", {horizon_state(world, middle_s), {}, middle_s}});
    return sights;
}

}  // namespace sim
