#include "data/polygon_layer.h"

#include <cpl_conv.h>
#include <ogr_srs_api.h>

#include <cmath>
#include <memory>

namespace data {

namespace {

struct GeometryDestroyer {
    void operator()(void* geometry) const { OGR_G_DestroyGeometry(static_cast<OGRGeometryH>(geometry)); }
};
using GeometryPtr = std::unique_ptr<void, GeometryDestroyer>;

std::vector<glm::dvec2> open_ring(OGRGeometryH ring) {
    std::vector<glm::dvec2> points;
    for (int i = 0; i < OGR_G_GetPointCount(ring); ++i) {
        const glm::dvec2 point(OGR_G_GetX(ring, i), OGR_G_GetY(ring, i));
        if (!std::isfinite(point.x) || !std::isfinite(point.y)) return {};
        points.push_back(point);
    }
    if (points.size() > 1 && points.front() == points.back()) points.pop_back();
    return points;
}

void append_linear(OGRGeometryH geometry, std::vector<RingPolygon>& out) {
    const OGRwkbGeometryType kind = wkbFlatten(OGR_G_GetGeometryType(geometry));
    const int parts = OGR_G_GetGeometryCount(geometry);
    if (kind == wkbPolygon || kind == wkbTriangle) {
        RingPolygon polygon;
        for (int i = 0; i < parts; ++i) {
            std::vector<glm::dvec2> ring = open_ring(OGR_G_GetGeometryRef(geometry, i));
            if (!ring.empty()) polygon.rings.push_back(std::move(ring));
            if (polygon.rings.empty()) return;
        }
        if (!polygon.rings.empty()) out.push_back(std::move(polygon));
    } else if (OGR_GT_IsSubClassOf(kind, wkbGeometryCollection) || kind == wkbPolyhedralSurface ||
               kind == wkbTIN) {
        for (int i = 0; i < parts; ++i)
            append_linear(OGR_G_GetGeometryRef(geometry, i), out);
    }
}

std::string wkt_of(OGRLayerH layer) {
    OGRSpatialReferenceH crs = OGR_L_GetSpatialRef(layer);
    char* text = nullptr;
    if (crs != nullptr) OSRExportToWkt(crs, &text);
    const std::string wkt = text == nullptr ? "" : text;
    CPLFree(text);
    return wkt;
}

bool is_in_degrees(OGRLayerH layer) {
    OGREnvelope extent;
    if (OGR_L_GetExtent(layer, &extent, TRUE) != OGRERR_NONE) return true;  // nothing there to contradict
    return extent.MinX >= -360.0 && extent.MaxX <= 360.0 && extent.MinY >= -90.0 && extent.MaxY <= 90.0;
}

}  // namespace

void append_ring_polygons(OGRGeometryH geometry, std::vector<RingPolygon>& out) {
    if (OGR_G_HasCurveGeometry(geometry, TRUE)) {
        const GeometryPtr linear(OGR_G_GetLinearGeometry(geometry, 0.0, nullptr));
        if (linear) append_linear(linear.get(), out);
    } else {
        append_linear(geometry, out);
    }
}

void SiteTransform::apply(RingPolygon& polygon) const {
    if (!crs) return;
    for (std::vector<glm::dvec2>& ring : polygon.rings)
        crs->degrees_from_crs(ring);
}

lod::Result<SiteTransform> site_transform(OGRLayerH layer, const WorldFrame& world, const std::string& path) {
    SiteTransform transform;
    if (!world.has_datum) return transform;
    lod::Result<GeodeticTransform> crs = GeodeticTransform::make(wkt_of(layer));
    if (!crs) return lod::Error{path + ": " + crs.message()};
    if (crs->kind() == CrsKind::kNone) {
        if (is_in_degrees(layer)) return transform;
        return lod::Error{
            path + ": layer " + OGR_L_GetName(layer) +
            " has no CRS and its extent is not in degrees; expected a CRS, as the terrain has one"};
    }
    transform.crs = std::move(*crs);
    return transform;
}

}  // namespace data
