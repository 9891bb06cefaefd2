// Buildings of boxes for tests: floors, columns, facade panels with joints between them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "objects/reduction/face_soup.h"

namespace objects_test {

inline constexpr std::array<std::array<uint32_t, 3>, 12> kBoxFaces = {{{0, 2, 1},
                                                                       {1, 2, 3},
                                                                       {4, 5, 6},
                                                                       {5, 7, 6},
                                                                       {0, 1, 4},
                                                                       {1, 5, 4},
                                                                       {2, 6, 3},
                                                                       {3, 6, 7},
                                                                       {0, 4, 2},
                                                                       {2, 4, 6},
                                                                       {1, 3, 5},
                                                                       {3, 7, 5}}};

inline void add_box(const glm::dvec3& low, const glm::dvec3& high, const glm::u8vec4& colour,
                    objects::FaceSoup& out) {
    const uint32_t base = static_cast<uint32_t>(out.points.size());
    for (int i = 0; i < 8; ++i)
        out.points.emplace_back((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                                (i & 4) != 0 ? high.z : low.z);
    for (const auto& [a, b, c] : kBoxFaces) {
        out.faces.push_back({a + base, b + base, c + base});
        out.colours.push_back(colour);
    }
}

/// A frame of `floors` storeys of 3.5 m, `bays` bays of 6 m both ways, clad in panels of 1.5 m.
inline objects::FaceSoup frame_building(int floors, int bays) {
    objects::FaceSoup out;
    const double side = 6.0 * bays;
    const glm::u8vec4 concrete(170, 170, 165, 255), facade(90, 120, 150, 255);
    for (int floor = 0; floor < floors; ++floor) {
        const double z = 3.5 * floor;
        add_box({0, 0, z + 3.2}, {side, side, z + 3.5}, concrete, out);
        for (int i = 0; i <= bays; ++i) {
            for (int k = 0; k <= bays; ++k) {
                const glm::dvec3 at(0.98 * 6.0 * i, 0.98 * 6.0 * k, z);
                add_box(at, at + glm::dvec3(0.5, 0.5, 3.2), concrete, out);
            }
        }
        for (double along = 0.0; along < side - 0.1; along += 1.5) {
            add_box({along + 0.01, -0.15, z}, {along + 1.49, -0.05, z + 3.48}, facade, out);
            add_box({along + 0.01, side + 0.05, z}, {along + 1.49, side + 0.15, z + 3.48}, facade, out);
            add_box({-0.15, along + 0.01, z}, {-0.05, along + 1.49, z + 3.48}, facade, out);
            add_box({side + 0.05, along + 0.01, z}, {side + 0.15, along + 1.49, z + 3.48}, facade, out);
        }
    }
    return out;
}

}  // namespace objects_test
