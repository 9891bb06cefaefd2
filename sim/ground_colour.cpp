#include "sim/ground_colour.h"

#include <algorithm>
#include <cmath>

#include "sim/noise.h"

namespace sim {
namespace {

constexpr glm::vec3 kStraw{0.80f, 0.73f, 0.50f}, kPasture{0.56f, 0.62f, 0.38f}, kCrop{0.45f, 0.53f, 0.31f};
constexpr glm::vec3 kHedge{0.28f, 0.36f, 0.22f};
constexpr glm::vec3 kForest{0.245f, 0.325f, 0.215f}, kWood{0.40f, 0.45f, 0.275f};
constexpr glm::vec3 kMeadow{0.58f, 0.60f, 0.40f}, kHeath{0.53f, 0.50f, 0.37f};
constexpr glm::vec3 kRock{0.64f, 0.60f, 0.55f}, kDarkRock{0.46f, 0.435f, 0.41f};
constexpr glm::vec3 kSnow{0.96f, 0.97f, 0.99f};
constexpr glm::vec3 kDeep{0.17f, 0.34f, 0.47f}, kShallow{0.36f, 0.58f, 0.62f}, kSand{0.78f, 0.73f, 0.60f};

float ramp(float low, float high, float x) {
    return glm::smoothstep(low, high, x);
}

/// Fields half as long again as they are wide, their borders a little bent; some hedges are gone.
glm::vec3 field_colour(const glm::vec2& position_m, float broad) {
    const glm::vec2 turned(0.8f * position_m.x - 0.6f * position_m.y,
                           0.6f * position_m.x + 0.8f * position_m.y);
    const Patch patch = patch_at(turned / glm::vec2(150.0f, 230.0f) + 0.5f * broad);
    glm::vec3 colour = patch.id < 0.25f ? kStraw : patch.id < 0.7f ? kPasture : kCrop;
    colour *= 0.90f + 0.20f * std::fmod(patch.id * 17.0f, 1.0f);
    const float hedge = 1.0f - ramp(0.02f, 0.07f, patch.border);
    return glm::mix(colour, kHedge, hedge * (patch.id * 7.0f - std::floor(patch.id * 7.0f)));
}

glm::vec3 sea_colour(const GroundSpot& spot, float noise) {
    const float depth = 1.0f - std::exp(-spot.shore_m / 900.0f);
    return glm::mix(kShallow, kDeep, depth) * (1.0f + 0.05f * noise);
}

}  // namespace

Climate climate_at(double latitude_rad) {
    const double degrees = std::abs(latitude_rad) * 57.29577951308232;
    const double snow_m = std::clamp(5200.0 - 53.0 * degrees, 300.0, 5000.0);
    return {static_cast<float>(std::max(snow_m - 950.0, 0.0)), static_cast<float>(snow_m)};
}

glm::vec3 ground_albedo(const GroundSpot& spot, const Climate& climate) {
    const float broad = fractal_noise(spot.position_m / 1900.0f, 4);
    const float fine = fractal_noise(spot.position_m / 140.0f, 4);
    if (spot.sea > 0.999f) return sea_colour(spot, broad);

    glm::vec3 colour = glm::mix(kForest, kWood, ramp(-0.35f, 0.45f, fine + 0.6f * broad));
    const float level = 1.0f - ramp(0.05f, 0.17f, spot.slope + 0.05f * fine);
    const float low = 1.0f - ramp(-10.0f, 45.0f, spot.prominence_m);
    const float warm =
        1.0f - ramp(climate.tree_line_m - 1100.0f, climate.tree_line_m - 600.0f, spot.height_m);
    const float farmed = level * low * warm * ramp(-0.30f, 0.05f, broad);
    if (farmed > 0.0f) colour = glm::mix(colour, field_colour(spot.position_m, broad), farmed);

    const float above_trees = spot.height_m + 260.0f * broad + 120.0f * fine;
    const glm::vec3 open = glm::mix(kHeath, kMeadow, ramp(-0.3f, 0.4f, fine + broad));
    colour =
        glm::mix(colour, open, ramp(climate.tree_line_m - 200.0f, climate.tree_line_m + 150.0f, above_trees));

    const float high = ramp(climate.snow_line_m - 900.0f, climate.snow_line_m, above_trees);
    const float steep = ramp(0.52f, 0.92f, spot.slope + 0.22f * fine + 0.10f * broad + 0.25f * high);
    const glm::vec3 rock = glm::mix(kDarkRock, kRock, ramp(-0.5f, 0.5f, fine));
    colour = glm::mix(colour, rock, std::max(steep, 0.75f * high));

    const float snowed = above_trees - 420.0f * std::max(spot.slope - 0.75f, 0.0f);
    colour =
        glm::mix(colour, kSnow, ramp(climate.snow_line_m - 120.0f, climate.snow_line_m + 220.0f, snowed));
    if (spot.sea > 0.0f) {
        const float beach = 1.0f - std::abs(2.0f * spot.sea - 1.0f);
        colour = glm::mix(glm::mix(colour, sea_colour(spot, broad), ramp(0.45f, 0.6f, spot.sea)), kSand,
                          0.35f * beach);
    }
    const float crowns = fractal_noise(spot.position_m / 27.0f, 3);
    const float rough = 1.0f - 0.75f * farmed;
    return colour * (1.0f + 0.12f * fine + 0.34f * crowns * rough * (1.0f - spot.sea));
}

}  // namespace sim
