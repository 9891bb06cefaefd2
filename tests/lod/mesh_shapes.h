// Shapes to build hierarchies from: parametric surfaces with smooth normals, and soups.
#pragma once

#include <cmath>
#include <functional>

#include "lod/progressive/surface_mesh.h"

namespace lod_test {

/// A grid of (cols x rows) quads under a map from [0, 1]^2; equal places are separate vertices where the map closes.
inline lod::SurfaceMesh parametric(int cols, int rows,
                                   const std::function<glm::dvec3(double, double)>& place) {
    lod::SurfaceMesh mesh;
    for (int row = 0; row <= rows; ++row) {
        for (int col = 0; col <= cols; ++col) {
            const double u = double(col) / cols, v = double(row) / rows;
            const glm::dvec3 across =
                glm::cross(place(u + 1e-6, v) - place(u - 1e-6, v), place(u, v + 1e-6) - place(u, v - 1e-6));
            const double length = glm::length(across);
            mesh.positions.emplace_back(place(u, v));
            mesh.normals.emplace_back(length > 0.0 ? across / length : glm::dvec3(0.0, 0.0, 1.0));
            mesh.colours.emplace_back(uint8_t{200}, uint8_t{200}, uint8_t{200}, uint8_t{3});
        }
    }
    for (int row = 0; row < rows; ++row) {
        for (int col = 0; col < cols; ++col) {
            const auto a = static_cast<uint32_t>(row * (cols + 1) + col), b = a + 1;
            const auto c = static_cast<uint32_t>(a + static_cast<uint32_t>(cols) + 1), d = c + 1;
            mesh.triangles.push_back({a, b, d});
            mesh.triangles.push_back({a, d, c});
        }
    }
    return mesh;
}

constexpr double kTurn = 6.283185307179586;

/// Closed: its ends meet bit for bit.
inline lod::SurfaceMesh torus(int cols, int rows, double tube = 0.3) {
    return parametric(cols, rows, [=](double u, double v) {
        const double a = kTurn * (u - std::floor(u)), b = kTurn * (v - std::floor(v));
        const double r = 1.0 + tube * std::cos(b);
        return glm::dvec3(r * std::cos(a), r * std::sin(a), tube * std::sin(b));
    });
}

inline lod::SurfaceMesh plane(int cols, int rows) {
    return parametric(cols, rows, [](double u, double v) { return glm::dvec3(u, v, 0.0); });
}

/// Waves over a square: curved both ways, with a border.
inline lod::SurfaceMesh waves(int cols, int rows) {
    return parametric(cols, rows, [](double u, double v) {
        return glm::dvec3(u, v, 0.08 * std::sin(7.0 * u) * std::cos(5.0 * v) + 0.01 * std::sin(40.0 * u * v));
    });
}

/// Unwelded, with hard edges: every face has its own corners and normal.
inline lod::SurfaceMesh box(int cuts) {
    lod::SurfaceMesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            const lod::SurfaceMesh face = parametric(cuts, cuts, [=](double u, double v) {
                glm::dvec3 p(0.0);
                p[axis] = side;
                p[(axis + 1) % 3] = side * (2.0 * u - 1.0);
                p[(axis + 2) % 3] = 2.0 * v - 1.0;
                return p;
            });
            const auto base = static_cast<uint32_t>(mesh.positions.size());
            mesh.positions.insert(mesh.positions.end(), face.positions.begin(), face.positions.end());
            mesh.normals.insert(mesh.normals.end(), face.normals.begin(), face.normals.end());
            mesh.colours.insert(mesh.colours.end(), face.colours.begin(), face.colours.end());
            for (auto triangle : face.triangles) {
                for (uint32_t& corner : triangle)
                    corner += base;
                mesh.triangles.push_back(triangle);
            }
        }
    }
    return mesh;
}

/// A mesh from places and triangles alone.
inline lod::SurfaceMesh soup(std::vector<glm::vec3> positions,
                             std::vector<std::array<uint32_t, 3>> triangles) {
    lod::SurfaceMesh mesh{std::move(positions), {}, {}, std::move(triangles)};
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0.0f, 0.0f, 1.0f));
    mesh.colours.assign(mesh.positions.size(),
                        glm::u8vec4(uint8_t{200}, uint8_t{200}, uint8_t{200}, uint8_t{3}));
    return mesh;
}

}  // namespace lod_test
