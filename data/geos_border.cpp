#include "data/geos_border.h"

#include <cmath>

namespace data {

namespace {

GeosGeometryPtr make_ring(GEOSContextHandle_t context, const std::vector<glm::dvec2>& ring) {
    const GeosGeometryCloser closer{context};
    GEOSCoordSequence* points = GEOSCoordSeq_create_r(context, static_cast<unsigned>(ring.size() + 1), 2);
    if (points == nullptr) return {nullptr, closer};
    for (unsigned i = 0; i <= ring.size(); ++i) {
        const glm::dvec2& point = ring[i % ring.size()];
        GEOSCoordSeq_setXY_r(context, points, i, point.x, point.y);
    }
    return {GEOSGeom_createLinearRing_r(context, points), closer};  // takes the points
}

std::vector<glm::dvec2> ring_of(GEOSContextHandle_t context, const GEOSGeometry* ring) {
    const GEOSCoordSequence* points = GEOSGeom_getCoordSeq_r(context, ring);
    unsigned count = 0;
    if (points == nullptr || GEOSCoordSeq_getSize_r(context, points, &count) == 0 || count == 0) return {};
    std::vector<glm::dvec2> result(count - 1);
    for (unsigned i = 0; i + 1 < count; ++i)
        GEOSCoordSeq_getXY_r(context, points, i, &result[i].x, &result[i].y);
    return result;
}

}  // namespace

double twice_signed_area(const std::vector<glm::dvec2>& ring) {
    double sum = 0.0;
    for (size_t i = 1; i + 1 < ring.size(); ++i) {
        const glm::dvec2 a = ring[i] - ring[0], b = ring[i + 1] - ring[0];
        sum += a.x * b.y - a.y * b.x;
    }
    return sum;
}

double area_of(const RingPolygon& polygon) {
    double area = 0.0;
    for (size_t i = 0; i < polygon.rings.size(); ++i) {
        const double ring_area = 0.5 * std::abs(twice_signed_area(polygon.rings[i]));
        area += i == 0 ? ring_area : -ring_area;
    }
    return area;
}

GeosContextPtr make_geos_context() {
    return GeosContextPtr(GEOS_init_r());
}

GeosGeometryPtr geos_from_polygon(GEOSContextHandle_t context, const RingPolygon& polygon) {
    const GeosGeometryCloser closer{context};
    std::vector<GeosGeometryPtr> rings;
    for (const std::vector<glm::dvec2>& ring : polygon.rings) {
        rings.push_back(make_ring(context, ring));
        if (!rings.back()) return {nullptr, closer};
    }
    std::vector<GEOSGeometry*> holes;
    for (size_t i = 1; i < rings.size(); ++i)
        holes.push_back(rings[i].release());
    return {GEOSGeom_createPolygon_r(context, rings[0].release(), holes.data(),
                                     static_cast<unsigned>(holes.size())),
            closer};
}

void append_polygons(GEOSContextHandle_t context, const GEOSGeometry* geometry,
                     std::vector<RingPolygon>& out) {
    const int kind = GEOSGeomTypeId_r(context, geometry);
    if (kind == GEOS_POLYGON) {
        RingPolygon polygon;
        polygon.rings.push_back(ring_of(context, GEOSGetExteriorRing_r(context, geometry)));
        for (int i = 0; i < GEOSGetNumInteriorRings_r(context, geometry); ++i)
            polygon.rings.push_back(ring_of(context, GEOSGetInteriorRingN_r(context, geometry, i)));
        out.push_back(std::move(polygon));
    } else if (kind == GEOS_MULTIPOLYGON || kind == GEOS_GEOMETRYCOLLECTION) {
        for (int i = 0; i < GEOSGetNumGeometries_r(context, geometry); ++i)
            append_polygons(context, GEOSGetGeometryN_r(context, geometry, i), out);
    }
}

}  // namespace data
