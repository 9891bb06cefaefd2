// Sunlight: where the sun of every scene stands and how its light meets the ground. A clear late morning.
//
// The renderer lights walls and instruments with the same figures (render/shaders/scene.vert).
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace sim {

/// Towards the sun, unit length, in a local east-north-up frame: east-south-east, 33 degrees high.
inline constexpr double kSunEast = 0.79, kSunSouth = 0.28, kSunUp = 0.5454356057317856;
inline constexpr glm::dvec3 kSunEnu{kSunEast, -kSunSouth, kSunUp};

inline constexpr glm::vec3 kSunLight{0.86f, 0.774f, 0.636f};  ///< linear, on a surface square to the sun
inline constexpr glm::vec3 kSkyLight{0.296f, 0.348f, 0.44f};  ///< linear, from the whole sky

/// Display colour of a matt surface, gamma taken as 2.
/// @param albedo    display values in [0, 1]
/// @param lambert   cosine to the sun times the share of it that is seen, [0, 1]
/// @param openness  share of the sky that is seen, [0, 1]
inline glm::vec3 lit(const glm::vec3& albedo, float lambert, float openness) {
    return glm::sqrt(albedo * albedo * (kSunLight * lambert + kSkyLight * openness));
}

}  // namespace sim
