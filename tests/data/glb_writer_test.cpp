#include "data/glb_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "data/generated_altimeter.h"
#include "tests/data/own_path.h"

namespace data {
namespace {

std::string temporary(const char* name) {
    return test::own_path(name);
}

const MeshNode* find(const PolygonMesh& mesh, const std::string& name) {
    for (const MeshNode& node : mesh.nodes) {
        if (node.name == name) return &node;
    }
    return nullptr;
}

/// Sum over all triangles of area and of area times middle, per node name, in the mesh frame.
struct Moments {
    double area = 0.0;
    glm::dvec3 first{0.0};
};

Moments moments_of(const PolygonMesh& mesh) {
    const std::vector<glm::dmat4> model = model_from_nodes(mesh);
    Moments sum;
    for (size_t i = 0; i < mesh.nodes.size(); ++i) {
        for (const auto& corners : mesh.nodes[i].triangles) {
            glm::dvec3 at[3];
            for (size_t k = 0; k < 3; ++k) {
                at[k] =
                    glm::dvec3(model[i] * glm::dvec4(glm::dvec3(mesh.nodes[i].positions[corners[k]]), 1.0));
            }
            const double area = glm::length(glm::cross(at[1] - at[0], at[2] - at[0])) / 2.0;
            sum.area += area;
            sum.first += area * (at[0] + at[1] + at[2]) / 3.0;
        }
    }
    return sum;
}

TEST(GlbWriter, AssimpReadsTheAltimeterBack) {
    const PolygonMesh mesh = generate_altimeter();
    const std::string path = temporary("harrier_glb_writer_test.glb");
    ASSERT_TRUE(write_glb(path, mesh));
    const lod::Result<PolygonMesh> back = read_polygon_mesh(path);
    ASSERT_TRUE(back) << back.message();
    size_t triangles = 0, read_triangles = 0;
    for (const MeshNode& node : mesh.nodes)
        triangles += node.triangles.size();
    for (const MeshNode& node : back->nodes)
        read_triangles += node.triangles.size();
    EXPECT_EQ(read_triangles, triangles);
    for (const MeshNode& node : mesh.nodes)
        EXPECT_NE(find(*back, node.name), nullptr) << node.name;
    const Moments wrote = moments_of(mesh), read = moments_of(*back);
    EXPECT_NEAR(read.area, wrote.area, 1e-6 * wrote.area);
    EXPECT_LT(glm::distance(read.first, wrote.first), 1e-7 * wrote.area) << "upright, front towards -y";
    for (const MeshMaterial& wanted : mesh.materials) {
        const auto same = [&wanted](const MeshMaterial& material) { return material.name == wanted.name; };
        const auto found = std::find_if(back->materials.begin(), back->materials.end(), same);
        if (found == back->materials.end()) continue;  // Assimp drops what no triangle uses
        EXPECT_LT(glm::distance(found->colour, wanted.colour), 0.004f) << wanted.name;
    }
    const MeshNode* glass = find(*back, "glass");
    EXPECT_LT(back->materials[glass->triangle_material[0]].colour.w, 0.5f);
    std::filesystem::remove(path);
}

TEST(GlbWriter, ChunksAreAlignedAndTheirLengthsTrue) {
    PolygonMesh mesh;
    mesh.materials.push_back({.name = "a \"quoted\" name"});
    MeshNode node;
    node.name = "three";
    node.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    node.normals.assign(3, {0, 0, 1});
    node.colours.assign(3, {1, 2, 3, 255});
    node.triangles = {{0, 1, 2}};
    node.triangle_material = {0};
    mesh.nodes.push_back(node);
    const std::vector<char> bytes = glb_bytes(mesh);
    const auto word = [&bytes](size_t offset) {
        uint32_t value = 0;
        std::memcpy(&value, bytes.data() + offset, 4);
        return value;
    };
    EXPECT_EQ(std::memcmp(bytes.data(), "glTF", 4), 0);
    EXPECT_EQ(word(4), 2u);
    EXPECT_EQ(word(8), bytes.size());
    const uint32_t json = word(12);
    EXPECT_EQ(json % 4, 0u);
    EXPECT_EQ(word(20 + json) % 4, 0u);
    EXPECT_EQ(20 + json + 8 + word(20 + json), bytes.size());
    EXPECT_EQ(word(20 + json), 2 * 36u + 8u) << "positions, normals, three 16-bit indices padded";
}

TEST(GlbWriter, SaysWhereItCannotWrite) {
    const lod::Result<lod::Ok> result = write_glb("/nowhere/at/all.glb", PolygonMesh{});
    ASSERT_FALSE(result);
    EXPECT_NE(result.message().find("/nowhere/at/all.glb"), std::string::npos);
}

}  // namespace
}  // namespace data
