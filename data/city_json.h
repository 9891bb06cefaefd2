// CityJSON: city objects with their surfaces, on the Earth where the file states its CRS.
#pragma once

#include <cstdint>
#include <string>

#include "data/source_scene.h"
#include "lod/base/result.h"

namespace data {

/// What the reader met.
struct CityJsonStats {
    uint64_t surfaces = 0;          ///< of the geometries that were read
    uint64_t without_area = 0;      ///< of those, left out
    uint64_t not_triangulated = 0;  ///< crossing themselves: filled as a fan around their first corner
    uint64_t without_geometry = 0;  ///< city objects that have none this reader knows
};

/// Whether a file that ends in .json is CityJSON: its first 4 KiB or its last say so.
bool is_city_json(const std::string& path);

/// Reads CityJSON 1.0 to 2.0: MultiSurface, CompositeSurface, Solid, MultiSolid and CompositeSolid, of each object the
/// geometry of the highest lod; transform; referenceSystem as an EPSG code. Every city object with surfaces is an object
/// named by its id, flat shaded, in colours of its type; materials, textures and geometry templates are left out.
/// With a CRS the scene frame is east, north, up at the middle of the data, at its lowest height; vertices are taken to
/// WGS84 one by one, heights as they are (docs/conventions.md). Without one it is the file's own frame, moved there.
/// Fails on what is no CityJSON or cut short, on indices and numbers that are none, and on a CRS that PROJ does not know.
/// Source: CityJSON specifications 2.0.1, sections 2 to 5.
lod::Result<SourceScene> read_city_json(const std::string& path, CityJsonStats* stats = nullptr);

}  // namespace data
