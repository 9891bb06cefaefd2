// ManifoldMesh: a triangle soup as a manifold with borders, ready for half-edges.
//
// Equal places are welded, collapsed and duplicate faces dropped. Where more than two triangles share an edge, those
// that continue one another most straightly are joined to sheets; a vertex becomes one leaf for each sheet around it.
// Leaves at edges that are left over are locked, so that what met there still meets in every front.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "lod/base/result.h"
#include "lod/progressive/surface_mesh.h"

namespace lod {

struct ManifoldMesh {
    std::vector<glm::vec3> positions;  ///< [leaves]
    std::vector<uint8_t> is_locked;    ///< [leaves]

    std::vector<std::array<uint32_t, 3>> triangles;         ///< of leaves
    std::vector<std::array<uint32_t, 3>> triangle_corners;  ///< [triangles] of vertices

    // [vertices]: distinct places, normals and colours; vertex n belongs to leaf n for n < leaves.
    std::vector<uint32_t> vertex_leaf;
    std::vector<glm::vec3> normals;
    std::vector<glm::u8vec4> colours;
};

/// @param weld_m  positions no farther apart than this become one, the first; 0: only equal ones
/// Fails when a position is not finite, an index is out of range or no triangle is left.
/// Cost: O(n log n).
Result<ManifoldMesh> make_manifold(const SurfaceMesh& mesh, double weld_m, MeshReport& report);

}  // namespace lod
