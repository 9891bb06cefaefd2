// Noise on the plane: a fixed function of position, for colours only. The same on every machine.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace sim {

/// Uniform in [0, 1) per lattice point; a mix of the two coordinates' bits.
inline float lattice_noise(int32_t x, int32_t y) {
    uint32_t h = static_cast<uint32_t>(x) * 0x8da6b343u ^ static_cast<uint32_t>(y) * 0xd8163841u;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    h ^= h >> 15;
    return static_cast<float>(h >> 8) * 0x1p-24f;
}

/// Value noise: the lattice joined by smooth steps, [0, 1), features of size 1.
inline float value_noise(glm::vec2 p) {
    const glm::vec2 cell = glm::floor(p);
    const glm::vec2 f = p - cell, s = f * f * (3.0f - 2.0f * f);
    const auto x = static_cast<int32_t>(cell.x), y = static_cast<int32_t>(cell.y);
    const float south = glm::mix(lattice_noise(x, y), lattice_noise(x + 1, y), s.x);
    const float north = glm::mix(lattice_noise(x, y + 1), lattice_noise(x + 1, y + 1), s.x);
    return glm::mix(south, north, s.y);
}

/// Sum of octaves, each twice as fine and half as strong; mean 0, within [-1, 1]. The lattice is turned from
/// octave to octave so that its axes do not show.
inline float fractal_noise(glm::vec2 p, int octaves) {
    float sum = 0.0f, weight = 0.5f;
    for (int i = 0; i < octaves; ++i) {
        sum += (value_noise(p) * 2.0f - 1.0f) * weight;
        p = glm::vec2(1.6f * p.x - 1.2f * p.y, 1.2f * p.x + 1.6f * p.y) + 17.3f;
        weight *= 0.5f;
    }
    return sum;
}

/// A patchwork: which patch holds `p`, and how near its border is.
struct Patch {
    float id = 0.0f;      ///< uniform in [0, 1), one per patch
    float border = 0.0f;  ///< 0 on the border, about 1 in the middle
};

/// Voronoi cells of lattice points moved a little: patches of size about 1, many with four sides.
inline Patch patch_at(glm::vec2 p) {
    const glm::vec2 base = glm::floor(p);
    float nearest = 1e9f, second = 1e9f;
    Patch patch;
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const glm::vec2 cell = base + glm::vec2(dx, dy);
            const auto x = static_cast<int32_t>(cell.x), y = static_cast<int32_t>(cell.y);
            const glm::vec2 jitter(lattice_noise(x, y), lattice_noise(y + 71, x - 13));
            const glm::vec2 seed = cell + 0.5f + 0.7f * (jitter - 0.5f) - p;
            const float distance = glm::dot(seed, seed);
            if (distance < nearest) {
                second = nearest;
                nearest = distance;
                patch.id = lattice_noise(x + 1009, y - 733);
            } else if (distance < second) {
                second = distance;
            }
        }
    }
    patch.border = std::sqrt(second) - std::sqrt(nearest);
    return patch;
}

}  // namespace sim
