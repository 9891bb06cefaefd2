// BuildingMesh: the walls, roof and underside of one footprint, flat shaded.
//
//     A'--------B'   roof height       A wall is a polygon: two corners above, a chain of feet below. Feet get
//     | \      /|                      Material::kWallFoot, so that the renderer can sink them by the ground's
//     f0-f1--f2-f3   source ground     error; a wall that hangs free (min_height) has only two lower corners.
//
// A wall is a fan around its upper left corner, the last index of each of its triangles: the renderer lays windows
// out from there (render/shaders/scene.vert). A fan may fold where the ground bulges; the fold lies in the ground.
#pragma once

#include <vector>

#include "data/footprints.h"
#include "lod/draw_list.h"
#include "objects/building_colours.h"
#include "objects/footing.h"

namespace objects {

/// World frame; three indices per triangle, counter-clockwise outside.
struct BuildingMesh {
    std::vector<lod::Vertex> vertices;
    std::vector<uint32_t> indices;
    glm::dvec3 base_world{0.0};  ///< the outer ring's first point on the source ground
    GroundProfile ground;        ///< along all rings; the mean along the outer one
};

/// Builds one building. `out` is cleared first; its capacity is kept.
/// @returns false when some of its ground is outside the terrain or void; `out` is then empty
bool mesh_building(const Ground& ground, const data::Footprint& footprint, const BuildingColours& colours,
                   BuildingMesh& out);

}  // namespace objects
