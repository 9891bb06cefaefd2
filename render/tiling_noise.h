// Tiling noise: smooth random functions on the unit square that repeat without a seam.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace render {

/// Uniform in [0, 1) per lattice point and seed; a mix of the bits.
inline float lattice_value(uint32_t x, uint32_t y, uint32_t seed) {
    uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ seed * 0xc2b2ae3du;
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    h ^= h >> 16;
    return static_cast<float>(h >> 8) * 0x1p-24f;
}

/// Smooth noise with `period` features across the unit square, mean 0, within [-1, 1].
/// @param p  in [0, 1]²; 0 and 1 are the same place
inline float tiling_noise(const glm::vec2& p, uint32_t period, uint32_t seed) {
    const glm::vec2 scaled = p * static_cast<float>(period), cell = glm::floor(scaled);
    const glm::vec2 f = scaled - cell, s = f * f * (3.0f - 2.0f * f);
    const uint32_t west = static_cast<uint32_t>(cell.x) % period, east = (west + 1) % period;
    const uint32_t south = static_cast<uint32_t>(cell.y) % period, north = (south + 1) % period;
    const float low = glm::mix(lattice_value(west, south, seed), lattice_value(east, south, seed), s.x);
    const float high = glm::mix(lattice_value(west, north, seed), lattice_value(east, north, seed), s.x);
    return 2.0f * glm::mix(low, high, s.y) - 1.0f;
}

/// Octaves of `tiling_noise` with doubling periods, each weighted `fade` times the one before.
struct Octaves {
    uint32_t first_period = 8;
    int count = 4;
    float fade = 0.6f;
};
inline float tiling_octaves(const glm::vec2& p, const Octaves& octaves, uint32_t seed) {
    float sum = 0.0f, weight = 1.0f;
    uint32_t period = octaves.first_period;
    for (int i = 0; i < octaves.count; ++i, period *= 2, weight *= octaves.fade)
        sum += weight * tiling_noise(p, period, seed + static_cast<uint32_t>(i));
    return sum;
}

}  // namespace render
