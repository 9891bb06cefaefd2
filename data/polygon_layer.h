// What OGR offers as areas: the layer of a data source, its polygons' rings, its coordinates as site coordinates.
#pragma once

#include <ogr_api.h>

#include <optional>
#include <string>
#include <vector>

#include "data/geodetic_transform.h"
#include "data/geos_border.h"
#include "data/world_frame.h"
#include "lod/base/result.h"

namespace data {

/// The polygons of a geometry, collections and curves resolved; heights left out. Rings with a coordinate that is
/// not finite are left out, and the polygon with them when it is the outer one.
void append_ring_polygons(OGRGeometryH geometry, std::vector<RingPolygon>& out);

/// A layer's coordinates to site coordinates.
struct SiteTransform {
    std::optional<GeodeticTransform> crs;  ///< none: the coordinates are site coordinates as they are

    /// In place; NaN where there is no counterpart.
    void apply(RingPolygon& polygon) const;
};

/// The transform of a layer in a world; with a datum, a layer without CRS passes when its extent is one of longitudes
/// and latitudes.
/// @param path  for the message
lod::Result<SiteTransform> site_transform(OGRLayerH layer, const WorldFrame& world, const std::string& path);

}  // namespace data
