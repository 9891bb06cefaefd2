// Footprints as a timed scene: every building an object, its walls on the ground (objects/building_mesh.h).
#pragma once

#include <string>

#include "data/footprints.h"
#include "data/height_grid.h"
#include "data/source_scene.h"
#include "data/timed_scene_file.h"
#include "lod/base/result.h"

namespace objects {

/// Where a scene's buildings stand. The scene frame is east, north, up at the middle of the footprints, on the ground;
/// without a datum the world's own axes there.
struct BuildingGround {
    data::WorldFrame world;
    const data::HeightGrid* grid = nullptr;  ///< null: the ground is at height 0
};

/// One object for each id, in the order of the footprints; parts of a building that follow one another are one object.
/// Buildings off the terrain are left out. Ids are the source's, as text.
data::SourceScene building_scene(const data::Footprints& footprints, const BuildingGround& ground);

/// data::read_timed_scene, and footprints from what OGR opens (.osm, .pbf, .shp, .gpkg, .geojson, .fgb, .gml, .kml and
/// .json that is no CityJSON), on the ground of `ground`. A source without CRS that is not in degrees is read as plane
/// metres.
lod::Result<data::TimedScene> read_timed_scene(const std::string& path,
                                               const data::TimedSceneOptions& options,
                                               const BuildingGround& ground = {});

}  // namespace objects
