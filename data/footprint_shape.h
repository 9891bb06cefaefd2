// A building's area made fit to be built: clean rings, valid polygons, a triangulated roof. Plane metres.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "data/geos_border.h"

namespace data {

/// Drops repeated points (closer than 1 mm), spikes and points in line with their neighbours (within 1 um), holes
/// that are left without area, and turns the outer ring counter-clockwise, the holes clockwise. The result is
/// without rings when the outer one has no area.
RingPolygon clean_rings(const RingPolygon& polygon);

struct ValidPolygons {
    std::vector<RingPolygon> parts;  ///< clean, simple, none smaller than 100 cm^2; empty beyond repair
    bool is_repaired = false;        ///< the polygon was not valid as it came
};

/// The polygon itself when it is valid, else the areas GEOS makes of it: the same region, even-odd.
ValidPolygons make_valid(GEOSContextHandle_t context, const RingPolygon& polygon);

/// Indices into the points of all rings in order; counter-clockwise.
using Triangles = std::vector<std::array<uint32_t, 3>>;

/// Constrained Delaunay triangles of a valid polygon. They cover it exactly and use every point of its rings (of
/// points that coincide, one); empty when GEOS cannot do that.
Triangles triangulate(GEOSContextHandle_t context, const RingPolygon& polygon);

}  // namespace data
