#include "data/scenes/solids.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace data {
namespace {

/// The volume inside by Gauss's theorem: right only where all faces are there and turned outwards.
double volume_of(const TimedMesh& mesh) {
    double volume = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::dvec3 p(mesh.positions[a]), q(mesh.positions[b]), r(mesh.positions[c]);
        volume += glm::dot(p, glm::cross(q, r)) / 6.0;
    }
    return volume;
}

using Place = std::array<float, 3>;

/// How many edges have no twin that runs the other way, by position.
size_t open_edges(const TimedMesh& mesh) {
    std::map<std::pair<Place, Place>, int> edges;
    const auto place = [&](uint32_t i) {
        return Place{mesh.positions[i].x, mesh.positions[i].y, mesh.positions[i].z};
    };
    for (const auto& triangle : mesh.triangles) {
        for (size_t i = 0; i < 3; ++i) {
            ++edges[{place(triangle[i]), place(triangle[(i + 1) % 3])}];
            --edges[{place(triangle[(i + 1) % 3]), place(triangle[i])}];
        }
    }
    size_t open = 0;
    for (const auto& [edge, balance] : edges)
        open += balance > 0 ? 1u : 0u;
    return open;
}

/// Faces whose normals do not agree with their corners' normals.
size_t turned_faces(const TimedMesh& mesh) {
    size_t turned = 0;
    for (const auto& triangle : mesh.triangles) {
        const auto& p = mesh.positions;
        const glm::vec3 normal = glm::cross(p[triangle[1]] - p[triangle[0]], p[triangle[2]] - p[triangle[0]]);
        for (uint32_t corner : triangle)
            turned += glm::dot(normal, mesh.normals[corner]) <= 0.0f ? 1u : 0u;
    }
    return turned;
}

void expect_solid(const TimedMesh& mesh, size_t triangles, double volume) {
    EXPECT_EQ(mesh.triangles.size(), triangles);
    EXPECT_EQ(open_edges(mesh), 0u);
    EXPECT_EQ(turned_faces(mesh), 0u);
    EXPECT_NEAR(volume_of(mesh), volume, 1e-4 * volume);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_EQ(mesh.colours.size(), mesh.positions.size());
    for (const glm::vec3& normal : mesh.normals)
        EXPECT_NEAR(glm::length(normal), 1.0f, 1e-5f);
}

constexpr Colour kGrey{120, 120, 120};

TEST(Solids, AreClosedAndOfTheRightVolume) {
    TimedMesh box, bar, upright, tube, lump;
    append_box({-1, -2, 3}, {2, 2, 5}, kGrey, box);
    expect_solid(box, 12, 24.0);
    append_bar({{0, 0, 0}, {3, 4, 12}, 0.5, 0.25}, kGrey, bar);
    expect_solid(bar, 12, 13.0 * 0.125);
    append_bar({{1, 1, 0}, {1, 1, -4}, 0.5, 0.25}, kGrey, upright);
    expect_solid(upright, 12, 0.5);
    append_tube({{1, 0, 2}, {1, 5, 2}, 0.5, 7}, kGrey, tube);
    expect_solid(tube, 24, 5.0 * 7.0 / 2.0 * 0.25 * std::sin(2.0 * std::numbers::pi / 7.0));
    append_lump({1, 2, 3}, {1, 1, 1}, kGrey, lump);
    EXPECT_EQ(lump.triangles.size(), 80u);
    EXPECT_EQ(open_edges(lump), 0u);
    EXPECT_EQ(turned_faces(lump), 0u);
    EXPECT_NEAR(volume_of(lump), 4.0 / 3.0 * std::numbers::pi, 0.6) << "somewhat less than the ball";
}

TEST(Solids, HeapsHaveAsManyTrianglesAsAskedFor) {
    for (uint64_t triangles = 9; triangles < 300; ++triangles) {
        TimedMesh heap;
        append_heap({2.0, 1.0, triangles}, kGrey, heap);
        ASSERT_EQ(heap.triangles.size(), triangles);
        ASSERT_EQ(turned_faces(heap), 0u) << triangles;
        TimedMesh ground = heap;  // with a lid on the open side it is closed
        const size_t rim = triangles - 2 * (triangles / 3);
        for (size_t i = 1; i + 1 < rim; ++i)
            ground.triangles.push_back({0u, static_cast<uint32_t>(i + 1), static_cast<uint32_t>(i)});
        ASSERT_EQ(open_edges(ground), 0u) << triangles;
    }
}

}  // namespace
}  // namespace data
