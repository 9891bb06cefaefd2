// A city of upright prisms on a lattice, by the counts of the paper's scene: 56,157 objects, no two alike, 4.26 million
// triangles. What other programs are asked to draw, too (city_compare.py).
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "data/timed_scene.h"
#include "lod/base/rng.h"

namespace bench {

inline constexpr uint32_t kCityObjects = 56157, kCityColumns = 237;
inline constexpr double kCityCell_m = 12.66;  ///< columns and rows of the lattice

/// Sides of a prism: 37 % of them have 4, and so on. A prism of n sides has 4 n - 4 triangles.
inline uint32_t city_sides(double share) {
    constexpr std::array<std::pair<double, uint32_t>, 5> kUpTo = {
        {{0.37, 4u}, {0.65, 12u}, {0.86, 24u}, {0.94, 48u}, {1.0, 104u}}};
    for (const auto& [end, sides] : kUpTo) {
        if (share < end) return sides;
    }
    return kUpTo.back().second;
}

/// Closed; foot at z = 0.
inline data::TimedMesh upright_prism(uint32_t sides, double radius_m, double height_m, double turn_rad,
                                     const glm::u8vec4& colour) {
    data::TimedMesh mesh;
    const auto add = [&](const glm::dvec3& at, const glm::dvec3& normal) {
        mesh.positions.emplace_back(at);
        mesh.normals.emplace_back(normal);
        mesh.colours.push_back(colour);
        return static_cast<uint32_t>(mesh.positions.size() - 1);
    };
    const auto around = [&](double corner) {
        const double angle = turn_rad + 2.0 * std::numbers::pi * corner / sides;
        return glm::dvec3(std::cos(angle), std::sin(angle), 0.0);
    };
    const glm::dvec3 up(0.0, 0.0, height_m);
    for (uint32_t i = 0; i < sides; ++i) {
        const glm::dvec3 left = radius_m * around(i), right = radius_m * around(i + 1.0);
        const glm::dvec3 outward = around(i + 0.5);
        const uint32_t a = add(left, outward), b = add(right, outward);
        const uint32_t c = add(right + up, outward), d = add(left + up, outward);
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
    }
    for (const bool is_roof : {false, true}) {
        const glm::dvec3 normal(0.0, 0.0, is_roof ? 1.0 : -1.0);
        const uint32_t first = static_cast<uint32_t>(mesh.positions.size());
        for (uint32_t i = 0; i < sides; ++i)
            add(radius_m * around(i) + (is_roof ? up : glm::dvec3(0.0)), normal);
        for (uint32_t i = 1; i + 1 < sides; ++i) {
            const uint32_t near = first + i, next = near + 1;
            mesh.triangles.push_back({first, is_roof ? near : next, is_roof ? next : near});
        }
    }
    return mesh;
}

/// There for ever; always the same. @param columns  of the lattice, the same in all its rows
inline data::TimedScene prism_city(uint32_t objects = kCityObjects, uint32_t columns = kCityColumns) {
    data::TimedScene scene;
    scene.end_s = 1.0;
    lod::Rng rng(1);
    for (uint32_t i = 0; i < objects; ++i) {
        const uint32_t sides = city_sides(rng.unit());
        const double radius_m = rng.between(2.0, 4.5);
        const double tall = rng.unit(), taller = rng.unit();
        const double height_m = 4.0 + 30.0 * tall * taller, turn_rad = rng.between(0.0, 6.28);
        const auto paint = [&](double least) {
            return static_cast<uint8_t>(255.0 * rng.between(least, 1.0));
        };
        const glm::u8vec4 colour(paint(0.5), paint(0.5), paint(0.5), 255);
        scene.meshes.push_back(upright_prism(sides, radius_m, height_m, turn_rad, colour));
        const glm::dvec3 at((i % columns + 0.5) * kCityCell_m, (i / columns + 0.5) * kCityCell_m, 0.0);
        scene.keys.push_back({0.0, at, {1.0, 0.0, 0.0, 0.0}});
        scene.objects.push_back({i, {0, 0}, {i, i + 1}, std::to_string(i)});
    }
    return scene;
}

}  // namespace bench
