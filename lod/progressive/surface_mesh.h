// SurfaceMesh: what a vertex hierarchy is built from, and what was met on the way.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace lod {

/// Drawn triangles over drawn vertices. Vertices that differ in normal or colour only are one place later.
struct SurfaceMesh {
    std::vector<glm::vec3> positions;                ///< mesh frame, any unit, finite
    std::vector<glm::vec3> normals;                  ///< [positions] unit length
    std::vector<glm::u8vec4> colours;                ///< [positions] sRGB; alpha: lod::Material
    std::vector<std::array<uint32_t, 3>> triangles;  ///< counter-clockwise outside
};

/// What building met and did. Counts.
struct MeshReport {
    uint32_t vertices_in = 0, triangles_in = 0;
    uint32_t places = 0;                 ///< distinct positions after welding
    uint32_t collapsed_faces = 0;        ///< dropped: two corners at one place
    uint32_t duplicate_faces = 0;        ///< dropped: same corners in the same order as an earlier one
    uint32_t zero_area_faces = 0;        ///< kept: three places on a line
    uint32_t border_edges = 0;           ///< with one triangle
    uint32_t non_manifold_edges = 0;     ///< with more than two triangles, or two that face opposite ways
    uint32_t non_manifold_vertices = 0;  ///< places where several sheets meet: split, one leaf a sheet
    uint32_t locked_leaves = 0;          ///< at edges that could not be shared out among sheets: never moved
    uint32_t seam_edges = 0;             ///< where normals or colours break between two triangles
    uint32_t components = 0;             ///< connected parts
};

}  // namespace lod
