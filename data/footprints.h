// Building footprints: rings in site coordinates with a height, cleaned and triangulated.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "data/world_frame.h"
#include "lod/base/result.h"

namespace data {

/// One building. Rings are open (the last point is not the first), without repeated points; the outer ring is
/// counter-clockwise seen from above, courtyards clockwise.
struct Footprint {
    std::vector<std::vector<glm::dvec2>> rings;  ///< [0] outer, [1..] courtyards; site x, y
    std::vector<std::array<uint32_t, 3>>
        triangles;          ///< roof; indices into the rings' points in order; counter-clockwise
    double height_m = 0.0;  ///< roof above the ground, > 0
    double min_height_m =
        0.0;         ///< underside above the ground (min_height, building:min_level), >= 0, < height_m
    int64_t id = 0;  ///< the source's id, else its ordinal
};

/// What the reader met, for the report.
struct FootprintStats {
    uint64_t read = 0;                          ///< features with a building's area
    uint64_t kept = 0;                          ///< of those, with at least one footprint
    uint64_t repaired = 0;                      ///< invalid rings made valid
    uint64_t skipped = 0;                       ///< beyond repair, or without area
    uint64_t courtyards = 0;                    ///< of the buildings kept
    uint64_t with_height = 0, with_levels = 0;  ///< of those kept, with a usable one; some have both
    uint64_t by_default = 0;                    ///< of those kept, with neither
};

struct Footprints {
    std::vector<Footprint> buildings;
    FootprintStats stats;
};

struct FootprintOptions {
    double default_height_m = 8.0;  ///< where neither height nor levels are known
    double storey_m = 3.2;          ///< metres per building:levels
};

/// Reads building footprints from anything OGR opens: OSM pbf and xml (areas with a `building` tag other than
/// `no`), Shapefile, GeoPackage, GeoJSON, CityJSON's footprint where OGR offers it (all polygons; where there is a
/// `building` column, those it says something other than `no` for). Heights from `height`, `building:height`,
/// `building:levels` (units m, ft and ' understood), also inside `other_tags`, else the default. Rings are taken to
/// site coordinates of `world` (WGS84 longitude/latitude, or untouched without a datum); the parts of a
/// multipolygon are buildings of their own with the same id.
/// Fails on an unreadable or truncated file (lines of CSV and GeoJSONSeq cut off whole do not show), on one that has
/// no polygon layer, and on coordinates that are not
/// degrees and have no CRS while the world has a datum.
lod::Result<Footprints> read_footprints(const std::string& path, const WorldFrame& world,
                                        const FootprintOptions& options);

}  // namespace data
