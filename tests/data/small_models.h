// Small models for tests, as the bytes of their files, and what every mesh that was read must hold.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "data/polygon_mesh.h"
#include "tests/data/own_path.h"

namespace test {

namespace fs = std::filesystem;

inline fs::path shared_data() {
    return fs::path(HARRIER_SOURCE_DIR) / "../shared/data";
}

inline std::string file_path(const std::string& name) {
    return own_path(name);
}

inline std::string write_file(const std::string& name, const std::string& content) {
    std::ofstream(file_path(name), std::ios::binary) << content;
    return file_path(name);
}

inline std::string bytes_of(const void* data, size_t count) {
    return {static_cast<const char*>(data), count};
}
template <typename T>
std::string bytes_of(const std::vector<T>& values) {
    return bytes_of(values.data(), values.size() * sizeof(T));
}
inline std::string word(uint32_t value) {
    return bytes_of(&value, 4);
}

inline std::string binary_stl(const std::vector<glm::vec3>& corners) {
    std::string text(80, ' ');
    text += word(static_cast<uint32_t>(corners.size() / 3));
    for (size_t i = 0; i < corners.size(); i += 3)
        text += std::string(12, '\0') + bytes_of(&corners[i], 36) + std::string(2, '\0');
    return text;
}

inline std::vector<glm::vec3> cube_corners() {
    std::vector<glm::vec3> corners;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 quad[4];
            for (int i = 0; i < 4; ++i) {
                quad[i][axis] = side;
                quad[i][(axis + 1) % 3] = (i == 1 || i == 2 ? 1.0f : -1.0f) * side;
                quad[i][(axis + 2) % 3] = i >= 2 ? 1.0f : -1.0f;
            }
            for (const int i : {0, 1, 2, 0, 2, 3})
                corners.push_back(quad[i]);
        }
    }
    return corners;
}

inline std::vector<glm::vec3> sphere_corners(int rings, int sectors) {
    const auto at = [&](int ring, int sector) {
        const double polar = std::numbers::pi * ring / rings,
                     turn = 2.0 * std::numbers::pi * (sector % sectors) / sectors;
        const double radius = ring == 0 || ring == rings ? 0.0 : std::sin(polar);
        return glm::vec3(radius * std::cos(turn), radius * std::sin(turn), std::cos(polar));
    };
    std::vector<glm::vec3> corners;
    for (int ring = 0; ring < rings; ++ring) {
        for (int sector = 0; sector < sectors; ++sector) {
            if (ring > 0)
                corners.insert(corners.end(), {at(ring, sector), at(ring + 1, sector), at(ring, sector + 1)});
            if (ring + 1 < rings)
                corners.insert(corners.end(),
                               {at(ring, sector + 1), at(ring + 1, sector), at(ring + 1, sector + 1)});
        }
    }
    return corners;
}

// Everything polygon_mesh.h promises of any mesh.
inline void check_promises(const data::PolygonMesh& mesh) {
    EXPECT_GT(mesh.triangle_count(), 0u);
    for (size_t n = 0; n < mesh.nodes.size(); ++n) {
        const data::MeshNode& node = mesh.nodes[n];
        ASSERT_LT(node.parent, static_cast<int32_t>(n));
        ASSERT_EQ(node.normals.size(), node.positions.size());
        ASSERT_EQ(node.colours.size(), node.positions.size());
        ASSERT_TRUE(node.uvs.empty() || node.uvs.size() == node.positions.size());
        ASSERT_EQ(node.triangle_material.size(), node.triangles.size());
        for (const glm::vec3& normal : node.normals)
            ASSERT_NEAR(glm::length(normal), 1.0f, 1e-4f);
        for (const glm::vec3& position : node.positions)
            ASSERT_TRUE(std::isfinite(position.x + position.y + position.z));
        for (const auto& [a, b, c] : node.triangles) {
            ASSERT_LT(std::max({a, b, c}), node.positions.size());
            ASSERT_TRUE(a != b && b != c && c != a);
        }
        for (const uint32_t material : node.triangle_material)
            ASSERT_LT(material, mesh.materials.size());
    }
    for (const data::MeshMaterial& material : mesh.materials)
        ASSERT_LT(material.texture, static_cast<int32_t>(mesh.textures.size()));
}

inline constexpr const char* kAc3d = R"(AC3Db
MATERIAL "red" rgb 1 0 0 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0.25
MATERIAL "lamp" rgb 0 1 0 amb 1 1 1 emis 0.5 1 0 spec 0 0 0 shi 0 trans 0
OBJECT world
kids 1
OBJECT group
name "case"
loc 1 2 3
kids 1
OBJECT poly
name "needle_100"
loc 0 0 10
numvert 6
0 0 0
1 0 0
1 1 0
0 1 0
2 0 0
2 1 0
numsurf 4
SURF 0x20
mat 0
refs 4
0 0 0
1 1 0
2 1 1
3 0 1
SURF 0x20
mat 1
refs 4
1 0 0
4 1 0
5 1 1
2 0 1
SURF 0x22
mat 0
refs 2
0 0 0
1 0 0
SURF 0x20
mat 0
refs 3
0 0 0
1 0 0
1 0 0
kids 1
OBJECT poly
name "tip"
loc 2 0 0
rot 0 1 0 -1 0 0 0 0 1
data 7
not loc

numvert 3
0 0 0
1 0 0
0 1 0
numsurf 1
SURF 0x20
mat 0
refs 3
0 0 0
1 0 0
2 0 0
kids 0
)";

inline std::string ply_text(const std::string& format, const std::string& body) {
    return "ply\nformat " + format +
           " 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar "
           "red\n"
           "property uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int "
           "vertex_index\nend_header\n" +
           body;
}

// One triangle below two nodes: the upper one moves along y, the lower one turns by 90 degrees about z.
inline std::string glb() {
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::vector<uint16_t> indices{0, 1, 2, 0};
    const std::vector<float> colours{0.5f, 1, 1, 1, 0.5f, 1, 1, 1, 0.5f, 1, 1, 1};
    const std::string binary = bytes_of(positions) + bytes_of(indices) + bytes_of(colours);
    std::string json =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
        R"("nodes":[{"name":"mast","translation":[0,5,0],"children":[1]},)"
        R"({"name":"jib","rotation":[0,0,0.70710678,0.70710678],"mesh":0}],)"
        R"("materials":[{"name":"m","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.0,1.0,0.5]}}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":2},"indices":1,"material":0}]}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
        R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"},)"
        R"({"bufferView":2,"componentType":5126,"count":3,"type":"VEC4"}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6},{"buffer":0,"byteOffset":44,"byteLength":48}],)"
        R"("buffers":[{"byteLength":92}]})";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const uint32_t length = static_cast<uint32_t>(12 + 8 + json.size() + 8 + binary.size());
    return "glTF" + word(2) + word(length) + word(static_cast<uint32_t>(json.size())) + "JSON" + json +
           word(static_cast<uint32_t>(binary.size())) + std::string("BIN\0", 4) + binary;
}

}  // namespace test
