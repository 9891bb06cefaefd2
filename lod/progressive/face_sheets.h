// FaceSheets: which triangles of a soup go on in one another across their sides, so that they make manifold sheets.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "lod/progressive/coarse_mesh.h"
#include "lod/progressive/manifold_mesh.h"

namespace lod {

/// Triangles as places, with what of the input they came from.
struct Faces {
    std::vector<std::array<uint32_t, 3>> places;
    std::vector<uint32_t> source;    ///< triangle of the input
    std::vector<glm::dvec3> normal;  ///< unit length; zero: no area
};

struct Sheets {
    std::vector<CornerId> mates;           ///< [corners] of the side that leaves it; kNoCorner: a border
    std::vector<uint8_t> is_place_locked;  ///< [places] of edges where more than two sides met
};

/// Joins sides that run opposite ways at one edge in pairs, the straightest continuation first; two triangles that lie on
/// each other are a sheet's border, not its bend.
/// @param report  border_edges and non_manifold_edges are counted
/// Cost: O(n log n).
Sheets join_sheets(const Faces& faces, uint32_t places, MeshReport& report);

}  // namespace lod
