// Small timed scenes for tests: boxes and a sphere-like body shared by objects that come, go and move.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "data/object_plan.h"
#include "lod/base/check.h"
#include "lod/base/rng.h"
#include "tests/objects/boxes.h"

namespace objects_test {

inline data::TimedMesh mesh_of(const objects::FaceSoup& soup) {
    data::TimedMesh mesh;
    for (size_t face = 0; face < soup.faces.size(); ++face) {
        const lod::Triangle t = soup.view().triangle(face);
        const glm::dvec3 cross = glm::cross(t.b - t.a, t.c - t.a);
        const double length = glm::length(cross);
        const uint32_t first = static_cast<uint32_t>(mesh.positions.size());
        for (const glm::dvec3& corner : {t.a, t.b, t.c}) {
            mesh.positions.emplace_back(corner);
            mesh.normals.push_back(length > 0.0 ? glm::vec3(cross / length) : glm::vec3(0, 0, 1));
            mesh.colours.push_back(soup.colours[face]);
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

inline objects::FaceSoup box(const glm::dvec3& size, const glm::u8vec4& colour) {
    objects::FaceSoup soup;
    add_box(-0.5 * size, 0.5 * size, colour, soup);
    return soup;
}

/// A ball of rows * columns * 2 triangles or a little fewer.
inline objects::FaceSoup ball(double radius_m, uint32_t rows, uint32_t columns, const glm::u8vec4& colour) {
    objects::FaceSoup soup;
    for (uint32_t row = 0; row <= rows; ++row) {
        for (uint32_t column = 0; column < columns; ++column) {
            const double up = 3.14159265 * row / rows, around = 6.28318531 * column / columns;
            soup.points.emplace_back(radius_m * std::sin(up) * std::cos(around),
                                     radius_m * std::sin(up) * std::sin(around), radius_m * std::cos(up));
        }
    }
    for (uint32_t row = 0; row < rows; ++row) {
        for (uint32_t column = 0; column < columns; ++column) {
            const uint32_t a = row * columns + column, b = row * columns + (column + 1) % columns;
            soup.faces.push_back({a, a + columns, b});
            soup.faces.push_back({b, a + columns, b + columns});
            soup.colours.insert(soup.colours.end(), {colour, colour});
        }
    }
    return soup;
}

struct SmallSceneOptions {
    uint32_t objects = 200;
    uint64_t seed = 1;
    double moving_share = 0.1;
    double side_m = 60.0;
};

/// Objects on a lattice, erected from one side to the other, some only for a while; the rest move about.
inline data::TimedScene small_scene(const SmallSceneOptions& options) {
    lod::Rng rng(options.seed);
    data::TimedScene scene;
    scene.end_s = 1000.0;
    scene.meshes.push_back(mesh_of(box({2.0, 2.0, 3.0}, {180, 90, 60, 255})));
    scene.meshes.push_back(mesh_of(box({3.0, 0.2, 3.0}, {90, 120, 200, 128})));
    scene.meshes.push_back(mesh_of(ball(1.0, 8, 12, {200, 200, 60, 255})));
    scene.meshes.push_back(mesh_of(box({2.0, 2.0, 3.0}, {180, 90, 60, 255})));  // equal to the first
    for (uint32_t i = 0; i < options.objects; ++i) {
        data::ObjectPlan plan;
        plan.mesh = static_cast<uint32_t>(rng.below(scene.meshes.size()));
        plan.id = "object" + std::to_string(i);
        const glm::dvec3 at(rng.between(0, options.side_m), rng.between(0, options.side_m),
                            rng.between(0, 20));
        const glm::dquat turn = glm::angleAxis(rng.between(0, 6.28), glm::dvec3(0, 0, 1));
        const double appears_s = scene.end_s * at.x / options.side_m;
        if (rng.unit() < 0.8) plan.events.push_back({appears_s, true});
        if (rng.unit() < 0.2) plan.events.push_back({appears_s + rng.between(0, 400), false});
        plan.keys.push_back({0.0, at, turn});
        if (rng.unit() < options.moving_share) {
            plan.keys.push_back({300.0, at + glm::dvec3(30, 0, 0), turn});
            plan.keys.push_back({700.0, at + glm::dvec3(30, 20, 0), glm::dquat(1, 0, 0, 0)});
        }
        CHECK(static_cast<bool>(data::append_object(plan, scene)));
    }
    return scene;
}

}  // namespace objects_test
