#include "sim/model_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sim {
namespace {

constexpr int kAltitude = signal_index("altitude_m");
constexpr int kHeading = signal_index("heading_deg");

/// A node with one triangle whose first corner is at `tip`.
data::MeshNode node_with_tip(const std::string& name, int parent, const glm::vec3& tip,
                             uint32_t material = 0) {
    data::MeshNode node;
    node.name = name;
    node.parent = parent;
    node.positions = {tip, tip + glm::vec3(0, -0.01f, 0), tip + glm::vec3(-0.01f, 0, 0)};
    node.normals.assign(3, glm::vec3(0, 0, 1));
    node.colours.assign(3, glm::u8vec4(10, 20, 30, 255));
    node.triangles = {{0, 2, 1}};
    node.triangle_material = {material};
    return node;
}

/// A dial whose frame is y up, z towards the viewer, as an instrument file has it.
data::PolygonMesh dial_with_needle() {
    data::PolygonMesh mesh;
    mesh.materials = {
        {.name = "paint"}, {.name = "glass", .colour = {1, 1, 1, 0.2f}}, {.name = "lamp", .emission = 1.0f}};
    mesh.nodes.push_back(node_with_tip("dial", -1, {0, 0, 0}));
    mesh.nodes[0].parent_from_node = glm::dmat4(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1);
    mesh.nodes.push_back(node_with_tip("needle_1000", 0, {0, 0.03f, 0}));
    mesh.nodes[1].parent_from_node[3] = glm::dvec4(0.01, 0.0, 0.002, 1.0);
    mesh.nodes.push_back(node_with_tip("flag", 1, {0, 0.02f, 0}, 2));
    mesh.nodes.push_back(node_with_tip("glass", 0, {0, 0, 0.01f}, 1));
    return mesh;
}

glm::dvec3 placed(const lod::BodyPose& pose, const lod::Vertex& vertex) {
    return pose.reference_from_body * position_of(vertex) + pose.origin;
}

Signals with(int signal, double value) {
    Signals signals;
    signals.value[static_cast<size_t>(signal)] = value;
    return signals;
}

TEST(ModelParts, NeedlesTurnClockwiseForThePilot) {
    const std::vector<Drive> drives{{"needle_1000", kAltitude}};
    const lod::Result<ModelParts> model =
        make_model_parts(dial_with_needle(), cockpit_pose({0.1, -0.2, -0.5}, 0.0, 1.0), drives);
    ASSERT_TRUE(model);
    ASSERT_EQ(model->bodies.size(), 2u);
    ASSERT_EQ(model->moving.size(), 1u);
    const lod::RigidPart* needle = nullptr;
    for (const lod::RigidPart& part : model->parts) {
        if (part.body == 1) needle = &part;
    }
    ASSERT_NE(needle, nullptr);
    EXPECT_EQ(needle->indices.size(), 6u) << "the flag rides on the needle";
    std::vector<lod::BodyPose> poses = model->bodies;
    const glm::dvec3 hub(0.11, -0.2, -0.498);  // +x right, +y up, +z towards the eye
    for (const double altitude : {0.0, 250.0, 400.0, 12345.0, -100.0}) {
        move_bodies(model->moving, with(kAltitude, altitude), poses);
        const double clock = 2.0 * std::numbers::pi * altitude / 1000.0;  // from twelve, clockwise
        const glm::dvec3 tip = hub + 0.03 * glm::dvec3(std::sin(clock), std::cos(clock), 0.0);
        EXPECT_LT(glm::distance(placed(poses[1], needle->vertices[0]), tip), 1e-8) << altitude;
    }
}

TEST(ModelParts, SortsMaterialsIntoPaintGlowAndGlass) {
    const lod::Result<ModelParts> model = make_model_parts(dial_with_needle(), lod::BodyPose{}, {});
    ASSERT_TRUE(model);
    ASSERT_EQ(model->parts.size(), 2u);
    EXPECT_FALSE(model->parts[0].is_glass);
    EXPECT_TRUE(model->parts[1].is_glass);
    std::array<int, 8> count{};
    for (const lod::RigidPart& part : model->parts) {
        for (const lod::Vertex& vertex : part.vertices)
            ++count[vertex.colour[3]];
    }
    EXPECT_EQ(count[static_cast<size_t>(lod::Material::kPaint)], 6);
    EXPECT_EQ(count[static_cast<size_t>(lod::Material::kGlow)], 3);
    EXPECT_EQ(count[static_cast<size_t>(lod::Material::kGlass)], 3);
}

TEST(ModelParts, AChildOfADrivenNodeMayTurnByItself) {
    data::PolygonMesh mesh = dial_with_needle();
    mesh.nodes[2].name = "flag_-360";  // counter-clockwise
    const std::vector<Drive> drives{{"flag_-360", kHeading}, {"needle_1000", kAltitude}};
    const lod::Result<ModelParts> model =
        make_model_parts(mesh, cockpit_pose(glm::dvec3(0.0), 0.0, 1.0), drives);
    ASSERT_TRUE(model);
    std::vector<lod::BodyPose> poses = model->bodies;
    Signals signals = with(kAltitude, 250.0);
    signals.value[static_cast<size_t>(kHeading)] = 90.0;
    move_bodies(model->moving, signals, poses);
    for (const lod::RigidPart& part : model->parts) {
        if (part.body != 2) continue;  // turned right by the needle, back left by itself
        EXPECT_LT(glm::distance(placed(poses[2], part.vertices[0]), glm::dvec3(0.01, 0.02, 0.002)), 1e-8);
    }
}

TEST(ModelParts, WorksScaleShearAndMirrorIntoTheVertices) {
    data::PolygonMesh mesh = dial_with_needle();
    glm::dmat4 squash(1.0);
    squash[0] = glm::dvec4(-2.0, 0.0, 0.0, 0.0);  // mirrored
    squash[1] = glm::dvec4(0.3, 0.5, 0.0, 0.0);
    mesh.nodes[1].parent_from_node = mesh.nodes[1].parent_from_node * squash;
    const std::vector<Drive> drives{{"needle_1000", kAltitude}};
    const lod::Result<ModelParts> model = make_model_parts(mesh, lod::BodyPose{}, drives);
    ASSERT_TRUE(model);
    const glm::dmat4 model_from_needle = mesh.nodes[0].parent_from_node * mesh.nodes[1].parent_from_node;
    for (const lod::RigidPart& part : model->parts) {
        if (part.body != 1) continue;
        const lod::BodyPose& pose = model->bodies[1];
        EXPECT_NEAR(glm::determinant(pose.reference_from_body), 1.0, 1e-12);
        const glm::dvec3 tip(model_from_needle * glm::dvec4(0, double(0.03f), 0, 1));
        EXPECT_LT(glm::distance(placed(pose, part.vertices[0]), tip), 1e-9);
        for (size_t t = 0; t < part.indices.size(); t += 3) {
            const glm::dvec3 a = position_of(part.vertices[part.indices[t]]),
                             b = position_of(part.vertices[part.indices[t + 1]]),
                             c = position_of(part.vertices[part.indices[t + 2]]);
            EXPECT_GT(glm::dot(glm::cross(b - a, c - a),
                               glm::dvec3(lod::decode_normal(part.vertices[part.indices[t]].surface))),
                      0.0);
        }
    }
}

TEST(ModelParts, SplitsLargeNodesAndKeepsTheirTriangles) {
    data::PolygonMesh mesh;
    mesh.materials.resize(1);
    data::MeshNode node = node_with_tip("grid", -1, {0, 0, 0});
    for (uint32_t i = 1; i < 20000; ++i) {
        node.positions.push_back(glm::vec3(static_cast<float>(i), static_cast<float>(i % 7), 0));
        node.normals.push_back({0, 0, 1});
        node.colours.push_back({1, 2, 3, 255});
        node.triangles.push_back({i - 1, i, i + 1});
        node.triangle_material.push_back(0);
    }
    mesh.nodes.push_back(node);
    const lod::Result<ModelParts> model = make_model_parts(mesh, lod::BodyPose{}, {});
    ASSERT_TRUE(model);
    size_t triangle = 0;
    EXPECT_GT(model->parts.size(), 3u);
    for (const lod::RigidPart& part : model->parts) {
        EXPECT_LT(part.vertices.size(), part.indices.size()) << "vertices are shared";
        for (size_t t = 0; t < part.indices.size(); t += 3, ++triangle) {
            for (size_t k = 0; k < 3; ++k) {
                ASSERT_EQ(position_of(part.vertices[part.indices[t + k]]),
                          glm::dvec3(node.positions[node.triangles[triangle][k]]));
            }
        }
    }
    EXPECT_EQ(triangle, node.triangles.size());
}

TEST(ModelParts, PlacedModelsFaceTheirHeading) {
    const data::WorldFrame planar{.has_datum = false};
    const lod::BodyPose east = placed_pose(planar, {100, 200, 30}, std::numbers::pi / 2.0, 2.0);
    const glm::dvec3 front = east.reference_from_body * glm::dvec3(0, -1, 0) + east.origin;
    EXPECT_LT(glm::distance(front, glm::dvec3(102, 200, 30)), 1e-9);
    const lod::BodyPose north = placed_pose(planar, {0, 0, 0}, 0.0, 1.0);
    EXPECT_LT(glm::distance(north.reference_from_body * glm::dvec3(0, -1, 0), glm::dvec3(0, 1, 0)), 1e-12);
    const data::WorldFrame earth{.has_datum = true};
    const lod::BodyPose pole = placed_pose(earth, {7.0, 43.0, 100.0}, 0.0, 1.0);
    const glm::dvec3 top = pole.reference_from_body * glm::dvec3(0, 0, 50) + pole.origin;
    EXPECT_NEAR(earth.site_from_world(top).height_m, 150.0, 1e-6);
}

TEST(ModelParts, RefusesDrivesItCannotFollow) {
    for (const char* name : {"needle", "needle_", "needle_x", "needle_0", "needle_100", "needle_nan"}) {
        const std::vector<Drive> drives{{name, 0}};
        data::PolygonMesh mesh = dial_with_needle();
        if (std::string(name) != "needle_100") mesh.nodes[1].name = name;
        const lod::Result<ModelParts> model = make_model_parts(mesh, lod::BodyPose{}, drives);
        ASSERT_FALSE(model) << name;
        EXPECT_NE(model.message().find(name), std::string::npos);
    }
}

TEST(ModelParts, AppendedModelsKeepTheirBodies) {
    const std::vector<Drive> drives{{"needle_1000", kAltitude}};
    const lod::Result<ModelParts> one = make_model_parts(dial_with_needle(), lod::BodyPose{}, drives);
    ASSERT_TRUE(one);
    ModelParts both;
    append_model(*one, both);
    append_model(*one, both);
    EXPECT_EQ(both.bodies.size(), 4u);
    EXPECT_EQ(both.parts.size(), 2 * one->parts.size());
    EXPECT_EQ(both.moving[1].body, 3u);
    EXPECT_EQ(both.moving[1].parent, 2u);
    EXPECT_EQ(both.parts.back().body, 2u) << "the glass of the second";
}

}  // namespace
}  // namespace sim
