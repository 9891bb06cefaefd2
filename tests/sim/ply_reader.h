// The program's PLY files, read by hand.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "tests/sim/temp_folder.h"

namespace sim_test {

using Face = std::array<uint32_t, 3>;

struct TriangleMesh {
    std::vector<glm::dvec3> vertices;
    std::vector<Face> faces;
    std::vector<uint8_t> module;  ///< [faces] 0 terrain, 1 objects, 2 instruments
};

inline TriangleMesh read_ply(const std::string& path) {
    const std::string bytes = read_all(path);
    TriangleMesh mesh;
    if (bytes.find("property uchar module\nend_header\n") == std::string::npos) {
        ADD_FAILURE() << path << " is no PLY of the program";
        return mesh;
    }
    mesh.vertices.resize(std::stoul(bytes.substr(bytes.find("element vertex ") + 15)));
    mesh.faces.resize(std::stoul(bytes.substr(bytes.find("element face ") + 13)));
    mesh.module.resize(mesh.faces.size());
    size_t at = bytes.find("end_header\n") + 11;
    EXPECT_EQ(bytes.size(), at + mesh.vertices.size() * 24 + mesh.faces.size() * 14);
    std::memcpy(mesh.vertices.data(), bytes.data() + at, mesh.vertices.size() * 24);
    at += mesh.vertices.size() * 24;
    for (size_t i = 0; i < mesh.faces.size(); ++i) {
        EXPECT_EQ(bytes[at], 3);
        std::memcpy(mesh.faces[i].data(), bytes.data() + at + 1, 12);
        mesh.module[i] = static_cast<uint8_t>(bytes[at + 13]);
        at += 14;
    }
    return mesh;
}

}  // namespace sim_test
