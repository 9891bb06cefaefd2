// The border to GEOS: a silent context and owned geometries, polygons to rings and back.
#pragma once

#include <geos_c.h>

#include <glm/glm.hpp>
#include <memory>
#include <vector>

namespace data {

/// An area: [0] the outer ring, [1..] holes; rings are open. Plane coordinates, metres.
struct RingPolygon {
    std::vector<std::vector<glm::dvec2>> rings;
};

/// Twice the signed area a ring encloses; positive when it runs counter-clockwise.
double twice_signed_area(const std::vector<glm::dvec2>& ring);

/// Area of the outer ring less the holes'.
double area_of(const RingPolygon& polygon);

struct GeosContextCloser {
    void operator()(GEOSContextHandle_t context) const { GEOS_finish_r(context); }
};
using GeosContextPtr = std::unique_ptr<GEOSContextHandle_HS, GeosContextCloser>;

struct GeosGeometryCloser {
    GEOSContextHandle_t context = nullptr;
    void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(context, geometry); }
};
using GeosGeometryPtr = std::unique_ptr<GEOSGeometry, GeosGeometryCloser>;

/// Prints nothing; functions of this context fail with null.
GeosContextPtr make_geos_context();

/// Null when GEOS refuses the rings.
/// @param polygon  every ring with at least three points
GeosGeometryPtr geos_from_polygon(GEOSContextHandle_t context, const RingPolygon& polygon);

/// All areas within any kind of geometry, points and lines left out; appended to `out`.
void append_polygons(GEOSContextHandle_t context, const GEOSGeometry* geometry,
                     std::vector<RingPolygon>& out);

}  // namespace data
