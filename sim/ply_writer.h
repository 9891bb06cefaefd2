// PLY: triangles as a binary file that other programs open.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "lod/base/result.h"
#include "render/renderer.h"

namespace sim {

/// A triangle mesh whose faces say which module they belong to.
struct PlyMesh {
    std::vector<glm::dvec3> vertices;
    std::vector<std::array<uint32_t, 3>> faces;
    std::vector<uint8_t> module;  ///< [faces]: 0 terrain, 1 objects, 2 instruments
};

/// Drawn triangles as a mesh: corners that agree bit for bit within a module become one vertex.
PlyMesh merge_corners(const render::DrawnTriangles& triangles);

/// Writes binary little-endian PLY: vertices double x, y, z; faces a list of three int indices and uchar module.
/// Fails on an unwritable path; the file appears complete or not at all. CHECKs fewer than 2^31 vertices.
lod::Result<lod::Ok> write_ply(const std::string& path, const PlyMesh& mesh);

}  // namespace sim
