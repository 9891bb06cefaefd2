#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "data/generated_altimeter.h"
#include "data/generated_gauges.h"
#include "data/glb_writer.h"
#include "data/solid.h"

namespace data {
namespace {

struct Triangle {
    glm::dvec3 a, b, c;
    glm::dvec3 normal_sum;
};

/// In the mesh frame.
std::vector<Triangle> triangles_of(const PolygonMesh& mesh, const std::string& only_node = "") {
    std::vector<glm::dmat4> model_from_node;
    std::vector<Triangle> triangles;
    for (const MeshNode& node : mesh.nodes) {
        const glm::dmat4 parent =
            node.parent < 0 ? glm::dmat4(1.0) : model_from_node[static_cast<size_t>(node.parent)];
        const glm::dmat4 matrix = parent * node.parent_from_node;
        model_from_node.push_back(matrix);
        if (!only_node.empty() && node.name != only_node) continue;
        for (const auto& corners : node.triangles) {
            glm::dvec3 at[3], normal(0.0);
            for (size_t k = 0; k < 3; ++k) {
                at[k] = glm::dvec3(matrix * glm::dvec4(glm::dvec3(node.positions[corners[k]]), 1.0));
                normal += glm::dmat3(matrix) * glm::dvec3(node.normals[corners[k]]);
            }
            triangles.push_back({at[0], at[1], at[2], normal});
        }
    }
    return triangles;
}

PolygonMesh empty_mesh() {
    PolygonMesh mesh;
    add_node(mesh, "solid", -1, glm::dmat4(1.0));
    add_material(mesh, "grey", {0.5f, 0.5f, 0.5f, 1.0f});
    return mesh;
}

double area(const Triangle& t) {
    return glm::length(glm::cross(t.b - t.a, t.c - t.a)) / 2.0;
}

/// Of a surface that is closed but for faces in the plane z = 0.
double volume(const std::vector<Triangle>& triangles) {
    double six = 0.0;
    for (const Triangle& t : triangles)
        six += glm::dot(t.a, glm::cross(t.b, t.c));
    return six / 6.0;
}

TEST(Solid, AnExtrusionEnclosesAreaTimesHeight) {
    PolygonMesh mesh = empty_mesh();
    const Shape frame = subtract(ring_shape(rounded_rectangle({0, 0}, {2, 1}, 0, 0)),
                                 ring_shape(rounded_rectangle({0, 0}, {1, 0.5}, 0, 0)));
    append_extrusion(frame, {.z0 = 0.0, .z1 = 3.0, .bevel = 0.0}, {.mesh = &mesh});
    EXPECT_NEAR(volume(triangles_of(mesh)), 6.0 * 3.0, 1e-5);
    PolygonMesh bevelled = empty_mesh();
    append_extrusion(ring_shape(rounded_rectangle({0, 0}, {2, 1}, 0, 0)),
                     {.z0 = 0.0, .z1 = 3.0, .bevel = 0.1}, {.mesh = &bevelled});
    const double frustum = 0.1 / 3.0 * (8.0 + 3.8 * 1.8 + std::sqrt(8.0 * 3.8 * 1.8));
    EXPECT_NEAR(volume(triangles_of(bevelled)), 8.0 * 2.9 + frustum, 1e-3);
}

TEST(Solid, ATurnedQuarterCircleIsAHemisphere) {
    PolygonMesh mesh = empty_mesh();
    std::vector<glm::dvec2> profile;
    for (int i = 0; i <= 64; ++i) {
        const double angle = std::numbers::pi / 2.0 * i / 64.0;
        profile.push_back({std::sin(angle), std::cos(angle)});
    }
    append_lathe(profile, 256, {.mesh = &mesh});
    double total = 0.0;
    for (const Triangle& t : triangles_of(mesh)) {
        total += area(t);
        EXPECT_GT(glm::dot(glm::normalize(t.normal_sum), glm::normalize(t.a + t.b + t.c)), 0.999);
    }
    EXPECT_NEAR(total, 2.0 * std::numbers::pi, 2e-3);
    EXPECT_NEAR(volume(triangles_of(mesh)), 2.0 / 3.0 * std::numbers::pi, 2e-3);
}

TEST(Solid, ANeedleIsClosedButForItsUnderside) {
    PolygonMesh mesh = empty_mesh();
    append_needle(std::vector<glm::dvec2>{{-2, 1}, {0, 1}, {4, 0}}, {.z0 = 0.0, .z1 = 0.5, .z_ridge = 0.5},
                  {.mesh = &mesh});
    EXPECT_NEAR(volume(triangles_of(mesh)), 0.5 * (4.0 + 4.0), 1e-6);
}

TEST(Solid, WeldingKeepsTheTriangles) {
    PolygonMesh mesh = empty_mesh();
    append_lathe(std::vector<glm::dvec2>{{0, 1}, {1, 1}, {1, 0}}, 16, {.mesh = &mesh});
    const std::vector<Triangle> before = triangles_of(mesh);
    const size_t vertices = mesh.nodes[0].positions.size();
    weld(mesh.nodes[0]);
    const std::vector<Triangle> after = triangles_of(mesh);
    EXPECT_LT(mesh.nodes[0].positions.size(), vertices / 2);
    ASSERT_EQ(after.size(), before.size());
    for (size_t i = 0; i < after.size(); ++i)
        EXPECT_TRUE(after[i].a == before[i].a && after[i].c == before[i].c);
}

struct NamedMesh {
    const char* name;
    PolygonMesh mesh;
};

std::vector<NamedMesh> all_instruments() {
    std::vector<NamedMesh> all;
    all.push_back({"altimeter", generate_altimeter()});
    all.push_back({"airspeed", generate_airspeed_indicator()});
    all.push_back({"heading", generate_heading_indicator()});
    all.push_back({"panel", generate_panel()});
    return all;
}

TEST(GeneratedGauges, TrianglesFaceWhereTheirNormalsPoint) {
    for (const NamedMesh& instrument : all_instruments()) {
        SCOPED_TRACE(instrument.name);
        for (const MeshNode& node : instrument.mesh.nodes) {
            ASSERT_EQ(node.normals.size(), node.positions.size());
            ASSERT_EQ(node.colours.size(), node.positions.size());
            ASSERT_EQ(node.triangle_material.size(), node.triangles.size());
            for (const glm::vec3& normal : node.normals)
                ASSERT_NEAR(glm::length(normal), 1.0f, 1e-5f);
        }
        for (const Triangle& t : triangles_of(instrument.mesh)) {
            const glm::dvec3 face = glm::cross(t.b - t.a, t.c - t.a);
            if (glm::length(face) < 1e-11) continue;  // a few square micrometres: rounding decides
            ASSERT_GT(glm::dot(glm::normalize(face), glm::normalize(t.normal_sum)), 0.0)
                << "at " << t.a.x << ", " << t.a.y << ", " << t.a.z << ", area " << area(t);
        }
    }
}

TEST(GeneratedGauges, TheAltimeterHasItsSizeItsHandsAndTensOfThousandsOfTriangles) {
    const PolygonMesh mesh = generate_altimeter();
    const size_t count = triangles_of(mesh).size();
    EXPECT_GT(count, 20000u);
    EXPECT_LT(count, 60000u);
    std::set<std::string> names;
    for (const MeshNode& node : mesh.nodes)
        names.insert(node.name);
    for (const char* name :
         {"needle_1000", "needle_10000", "needle_100000", "pressure_drum", "knob", "glass"}) {
        EXPECT_TRUE(names.contains(name)) << name;
    }
    double reach = 0.0;
    for (const Triangle& t : triangles_of(mesh, "dial")) {
        reach = std::max(reach, std::hypot(t.a.x, t.a.z));
        EXPECT_GT(t.a.y, -0.006) << "in front of the glass";
    }
    EXPECT_NEAR(reach, 0.040, 0.0005);
    for (const char* hand : {"needle_1000", "needle_10000", "needle_100000"}) {
        double low = 1.0, high = -1.0, tip = 0.0;
        for (const Triangle& t : triangles_of(mesh, hand)) {
            for (const glm::dvec3& corner : {t.a, t.b, t.c}) {
                low = std::min(low, corner.x);
                high = std::max(high, corner.x);
                tip = std::max(tip, corner.z);
            }
        }
        EXPECT_NEAR(low, -high, 1e-6) << hand << " points to twelve";
        EXPECT_GT(tip, 0.02);
        EXPECT_LT(tip, 0.038) << hand << " stays on the dial";
    }
}

TEST(GeneratedGauges, AreTheSameEveryTime) {
    const std::vector<NamedMesh> first = all_instruments(), second = all_instruments();
    for (size_t i = 0; i < first.size(); ++i)
        EXPECT_EQ(glb_bytes(first[i].mesh), glb_bytes(second[i].mesh));
}

}  // namespace
}  // namespace data
