// Buildings: footprints on the ground become walls and roofs, grouped into cells along a Hilbert curve.
#pragma once

#include <vector>

#include "data/footprints.h"
#include "data/height_grid.h"
#include "lod/rigid_front.h"
#include "objects/footing.h"

namespace objects {

/// What was built, for reports and the building-base check.
struct BuildingSite {
    glm::dvec3 base_world{0.0};  ///< the outer ring's first point on the source ground
    double lowest_ground_m = 0.0, highest_ground_m = 0.0;   ///< source ground along the rings
    uint32_t footprint = 0;                                 ///< index into the input
    uint32_t part = 0, first_vertex = 0, vertex_count = 0;  ///< where its vertices are
};

struct Buildings {
    std::vector<lod::RigidPart> parts;  ///< body 0, world frame
    std::vector<BuildingSite> sites;
    uint64_t off_terrain = 0;  ///< footprints outside the terrain or on a void: not built
};

struct BuildingOptions {
    uint32_t triangles_per_cell = 2000;  ///< a cell, the unit of culling, ends beyond this many
    uint64_t colour_seed = 1;            ///< walls and roofs vary in colour from building to building
};

/// Walls follow the source ground exactly: every wall is cut where it crosses an edge of the full-resolution
/// terrain mesh, its foot (Material::kWallFoot) lies on that mesh; a floor of min_height hangs free. The roof is
/// flat at height_m above the mean ground along the outer ring, at least 2 m above the highest. Facades are Material::kWall, roofs kRoof, both with the footprint's own normal.
/// @param ground  null: no terrain; buildings stand at height 0 of the site frame
Buildings build_buildings(const data::Footprints& footprints, const data::HeightGrid* ground,
                          const data::WorldFrame& world, const BuildingOptions& options);

/// Samples the ground under a building depends on; empty where it stands on none.
data::SampleRange ground_under(const data::Footprint& footprint, const data::HeightGrid& ground);

/// Builds one building again, for ground whose heights have changed: as build_buildings would now, with as many
/// vertices, so that it settles or rises with its ground. Its place among the parts stays.
/// @param site      as build_buildings gave it; brought up to date
/// @param vertices  cleared first
void rebuild_building(const data::Footprint& footprint, const Ground& ground, const BuildingOptions& options,
                      BuildingSite& site, std::vector<lod::Vertex>& vertices);

}  // namespace objects
