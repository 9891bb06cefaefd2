#include "data/polygon_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <sstream>

#include "lod/base/rng.h"
#include "tests/data/small_models.h"

namespace {

namespace fs = std::filesystem;
using data::MeshNode;
using data::PolygonMesh;
using data::PolygonMeshStats;
using namespace test;

double area_of(const MeshNode& node) {
    double area = 0.0;
    for (const auto& [a, b, c] : node.triangles) {
        const glm::dvec3 p(node.positions[a]), q(node.positions[b]), r(node.positions[c]);
        area += 0.5 * glm::length(glm::cross(q - p, r - p));
    }
    return area;
}

const MeshNode* node_named(const PolygonMesh& mesh, const std::string& name) {
    for (const MeshNode& node : mesh.nodes) {
        if (node.name == name) return &node;
    }
    return nullptr;
}

std::string obj_polygon(const std::vector<glm::dvec2>& ring) {
    std::ostringstream text;
    text.precision(9);
    for (const glm::dvec2& point : ring)
        text << "v " << point.x << " " << point.y << " 0\n";
    text << "f";
    for (size_t i = 1; i <= ring.size(); ++i)
        text << " " << i;
    text << "\n";
    return text.str();
}

TEST(PolygonMesh, TriangulatesNonConvexPolygonsWithoutLoss) {
    lod::Rng rng(5);
    for (int n = 0; n < 200; ++n) {
        SCOPED_TRACE(n);
        const size_t count = 3 + rng.below(n < 100 ? 4 : 40);
        std::vector<glm::dvec2> ring;
        double area = 0.0;
        for (size_t i = 0; i < count; ++i) {
            const double angle = 2.0 * std::numbers::pi * (static_cast<double>(i) + 0.8 * rng.unit()) /
                                 static_cast<double>(count);
            const double radius = n % 3 == 0 ? 1.0 : rng.between(0.3, 1.0);
            ring.push_back(radius * glm::dvec2(std::cos(angle), std::sin(angle)));
        }
        for (size_t i = 0; i < count; ++i) {
            const glm::dvec2 &a = ring[i], &b = ring[(i + 1) % count];
            area += 0.5 * (a.x * b.y - a.y * b.x);
        }
        PolygonMeshStats stats;
        const auto mesh = data::read_polygon_mesh(write_file("ring.obj", obj_polygon(ring)), &stats);
        ASSERT_TRUE(mesh) << mesh.message();
        EXPECT_EQ(mesh->triangle_count(), count - 2);
        EXPECT_EQ(stats.polygons, 1u);
        EXPECT_EQ(stats.larger_than_triangles, count > 3 ? 1u : 0u);
        double covered = 0.0;
        for (const MeshNode& node : mesh->nodes)
            covered += area_of(node);
        EXPECT_NEAR(covered, std::abs(area), 1e-5);
    }
}

TEST(PolygonMesh, ReadsAc3dNodesAndMaterials) {
    PolygonMeshStats stats;
    const auto mesh = data::read_polygon_mesh(write_file("two.ac", kAc3d), &stats);
    ASSERT_TRUE(mesh) << mesh.message();
    check_promises(*mesh);
    const MeshNode* needle = node_named(*mesh, "needle_100");
    ASSERT_NE(needle, nullptr);
    EXPECT_EQ(needle->triangles.size(), 4u);
    EXPECT_EQ(mesh->triangle_count(), 5u);
    EXPECT_EQ(stats.polygons, 5u);
    EXPECT_EQ(stats.larger_than_triangles, 2u);
    EXPECT_EQ(stats.dropped_faces, 2u);  // the line and the triangle with a repeated corner
    EXPECT_EQ(mesh->nodes[static_cast<size_t>(needle->parent)].name, "case");

    // In its own frame the needle is as the file has it; in the model it is moved, then turned (x, -z, y).
    const size_t index = static_cast<size_t>(needle - mesh->nodes.data());
    const glm::dvec4 corner = data::model_from_nodes(*mesh)[index] * glm::dvec4(2.0, 1.0, 0.0, 1.0);
    EXPECT_NEAR(glm::distance(glm::dvec3(corner), glm::dvec3(3.0, -13.0, 3.0)), 0.0, 1e-6);
    for (const glm::vec3& position : needle->positions)
        EXPECT_EQ(position.z, 0.0f);
    const MeshNode* tip = node_named(*mesh, "tip");  // stands on the needle, turned a quarter about z
    ASSERT_NE(tip, nullptr);
    const glm::dmat4 model_from_tip =
        data::model_from_nodes(*mesh)[static_cast<size_t>(tip - mesh->nodes.data())];
    EXPECT_EQ(tip->positions[1], glm::vec3(1, 0, 0));
    EXPECT_NEAR(glm::distance(glm::dvec3(model_from_tip * glm::dvec4(1, 0, 0, 1)), glm::dvec3(3, -13, 1)),
                0.0, 1e-6);

    for (size_t t = 0; t < 4; ++t) {
        const data::MeshMaterial& material = mesh->materials[needle->triangle_material[t]];
        const glm::u8vec4 colour = needle->colours[needle->triangles[t][0]];
        if (material.name == "red") {
            EXPECT_EQ(colour, glm::u8vec4(255, 0, 0, 191));
            EXPECT_EQ(material.emission, 0.0f);
        } else {
            EXPECT_EQ(material.name, "lamp");
            EXPECT_EQ(colour, glm::u8vec4(0, 255, 0, 255));
            EXPECT_EQ(material.emission, 1.0f);
        }
        for (const uint32_t i : needle->triangles[t])
            EXPECT_NEAR(glm::distance(needle->normals[i], glm::vec3(0, 0, 1)), 0.0f, 1e-6f);
    }
}

TEST(PolygonMesh, NormalsAreSmoothOnCurvesAndSharpOnEdges) {
    const auto cube = data::read_polygon_mesh(write_file("cube.stl", binary_stl(cube_corners())));
    ASSERT_TRUE(cube) << cube.message();
    check_promises(*cube);
    EXPECT_EQ(cube->triangle_count(), 12u);
    for (const MeshNode& node : cube->nodes) {
        EXPECT_TRUE(node.positions.empty() || node.positions.size() == 24u);  // four for each side
        for (const auto& [a, b, c] : node.triangles) {
            const glm::vec3 facet = glm::normalize(
                glm::cross(node.positions[b] - node.positions[a], node.positions[c] - node.positions[a]));
            for (const uint32_t corner : {a, b, c})
                EXPECT_NEAR(glm::distance(node.normals[corner], facet), 0.0f, 1e-6f);
            EXPECT_GT(glm::dot(facet, node.positions[a]), 0.5f);  // outside
        }
    }
    const auto sphere = data::read_polygon_mesh(write_file("sphere.stl", binary_stl(sphere_corners(24, 48))));
    ASSERT_TRUE(sphere) << sphere.message();
    size_t vertices = 0;
    for (const MeshNode& node : sphere->nodes) {
        vertices += node.positions.size();
        for (size_t i = 0; i < node.positions.size(); ++i)
            EXPECT_GT(glm::dot(node.normals[i], node.positions[i]), 0.999f);
    }
    EXPECT_EQ(vertices, 23u * 48u + 2u);  // every corner welded
}

TEST(PolygonMesh, FileNormalsAreKept) {
    const auto mesh = data::read_polygon_mesh(
        write_file("normals.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0.6 0 0.8\nvn 0 2 0\nf 1//1 2//1 3//2\n"));
    ASSERT_TRUE(mesh) << mesh.message();
    for (const MeshNode& node : mesh->nodes) {
        for (size_t i = 0; i < node.positions.size(); ++i) {
            const glm::vec3 wanted =
                node.positions[i].y > 0.5f ? glm::vec3(0, 1, 0) : glm::vec3(0.6f, 0, 0.8f);
            EXPECT_NEAR(glm::distance(node.normals[i], wanted), 0.0f, 1e-6f);
        }
    }
}

TEST(PolygonMesh, GltfIsTurnedUprightAndItsColoursAreLinear) {
    const auto mesh = data::read_polygon_mesh(write_file("crane.glb", glb()));
    ASSERT_TRUE(mesh) << mesh.message();
    check_promises(*mesh);
    const MeshNode* jib = node_named(*mesh, "jib");
    ASSERT_NE(jib, nullptr);
    const glm::dmat4 model = data::model_from_nodes(*mesh)[static_cast<size_t>(jib - mesh->nodes.data())];
    // x of the jib points along the file's y, which is up: model z.
    EXPECT_NEAR(glm::distance(glm::dvec3(model * glm::dvec4(1, 0, 0, 1)), glm::dvec3(0, 0, 6)), 0.0, 1e-6);
    EXPECT_NEAR(glm::distance(glm::dvec3(model * glm::dvec4(0, 0, 1, 1)), glm::dvec3(0, -1, 5)), 0.0, 1e-6);
    // Half of the light is sRGB 188 for the material and for the vertices, which multiply it:
    EXPECT_EQ(jib->colours[0], glm::u8vec4(138, 0, 255, 255));  // opaque unless alphaMode says otherwise
}

TEST(PolygonMesh, ReadsTheInstruments) {
    struct Fact {
        const char* path;
        uint64_t triangles;  // with those that are dropped for two equal corners
        bool has_textures;
    };
    const Fact facts[] = {
        {"A-14A-OxReg/A-14A.ac", 11'756, true}, {"GDU-104X/GDU-104X.1.ac", 19'939, false},
        {"GMC710/GMC710.ac", 10'484, true},     {"motor.stl.gz", 13'506, false},
        {"bearing.stl.gz", 24'696, false},      {"ADIS16480.STL", 7'436, false},
    };
    for (const Fact& fact : facts) {
        const fs::path path = shared_data() / "instruments" / fact.path;
        if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
        PolygonMeshStats stats;
        const auto mesh = data::read_polygon_mesh(path.string(), &stats);
        ASSERT_TRUE(mesh) << mesh.message();
        SCOPED_TRACE(fact.path);
        check_promises(*mesh);
        EXPECT_EQ(mesh->triangle_count() + stats.dropped_faces, fact.triangles);
        EXPECT_EQ(!mesh->textures.empty(), fact.has_textures);
        std::set<uint32_t> colours;
        for (const MeshNode& node : mesh->nodes) {
            for (const glm::u8vec4& colour : node.colours)
                colours.insert(static_cast<uint32_t>(colour.x << 16 | colour.y << 8 | colour.z));
        }
        EXPECT_GT(colours.size(), fact.has_textures ? 20u : 0u);
    }
}

TEST(PolygonMesh, EveryModelInTheDataFolderReads) {
    if (!fs::exists(shared_data())) GTEST_SKIP() << "no " << shared_data();
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(shared_data())) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".ac" && extension != ".glb") continue;
        SCOPED_TRACE(entry.path());
        const auto mesh = data::read_polygon_mesh(entry.path().string());
        ASSERT_TRUE(mesh) << mesh.message();
        check_promises(*mesh);
    }
}

}  // namespace
