#include "data/outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "data/footprint_shape.h"
#include "data/geos_border.h"
#include "lod/base/check.h"

namespace data {

namespace {

using Context = GEOSContextHandle_t;

/// GEOS refusing a shape made here is a programmer's mistake.
GeosGeometryPtr own(Context context, GEOSGeometry* geometry) {
    CHECK(geometry != nullptr);
    return {geometry, GeosGeometryCloser{context}};
}

/// Hands the parts over to one collection.
GeosGeometryPtr collect(Context context, int type, std::vector<GEOSGeometry*>& parts) {
    const unsigned count = static_cast<unsigned>(parts.size());
    return own(context, GEOSGeom_createCollection_r(context, type, parts.data(), count));
}

GeosGeometryPtr geometry_of(Context context, const Shape& shape) {
    std::vector<GEOSGeometry*> polygons;
    for (const Outline& outline : shape) {
        polygons.push_back(geos_from_polygon(context, {outline.rings}).release());
        CHECK(polygons.back() != nullptr);
    }
    return collect(context, GEOS_MULTIPOLYGON, polygons);
}

GEOSGeometry* line_of(Context context, const Polyline& line) {
    std::vector<double> xy;
    for (const glm::dvec2& point : line)
        xy.insert(xy.end(), {point.x, point.y});
    const unsigned count = static_cast<unsigned>(line.size());
    return GEOSGeom_createLineString_r(context,
                                       GEOSCoordSeq_copyFromBuffer_r(context, xy.data(), count, 0, 0));
}

Shape shape_of(Context context, const GEOSGeometry* geometry) {
    std::vector<RingPolygon> polygons;
    append_polygons(context, geometry, polygons);
    Shape shape;
    for (RingPolygon& polygon : polygons) {
        for (size_t i = 0; i < polygon.rings.size(); ++i) {
            const bool is_counter_clockwise = twice_signed_area(polygon.rings[i]) > 0.0;
            if (is_counter_clockwise != (i == 0))
                std::reverse(polygon.rings[i].begin(), polygon.rings[i].end());
        }
        shape.push_back({polygon.rings, triangulate(context, polygon)});
    }
    return shape;
}

}  // namespace

Shape stroke_shape(std::span<const Polyline> strokes, double width, int quarter_segments) {
    const GeosContextPtr context = make_geos_context();
    std::vector<GEOSGeometry*> lines;
    for (const Polyline& stroke : strokes)
        lines.push_back(line_of(context.get(), stroke));
    const GeosGeometryPtr all = collect(context.get(), GEOS_MULTILINESTRING, lines);
    return shape_of(
        context.get(),
        own(context.get(), GEOSBuffer_r(context.get(), all.get(), width / 2.0, quarter_segments)).get());
}

Shape ring_shape(const Polyline& ring) {
    const GeosContextPtr context = make_geos_context();
    const GeosGeometryPtr polygon = geos_from_polygon(context.get(), {{ring}});
    CHECK(polygon != nullptr);
    return shape_of(context.get(), polygon.get());
}

Shape unite(const Shape& a, const Shape& b) {
    const GeosContextPtr context = make_geos_context();
    const GeosGeometryPtr left = geometry_of(context.get(), a), right = geometry_of(context.get(), b);
    return shape_of(context.get(),
                    own(context.get(), GEOSUnion_r(context.get(), left.get(), right.get())).get());
}

Shape subtract(const Shape& a, const Shape& b) {
    const GeosContextPtr context = make_geos_context();
    const GeosGeometryPtr left = geometry_of(context.get(), a), right = geometry_of(context.get(), b);
    return shape_of(context.get(),
                    own(context.get(), GEOSDifference_r(context.get(), left.get(), right.get())).get());
}

Polyline circle(const glm::dvec2& centre, double radius, int count) {
    Polyline points;
    for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / count;
        points.push_back(centre + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return points;
}

Polyline rounded_rectangle(const glm::dvec2& centre, const glm::dvec2& half, double radius,
                           int corner_segments) {
    Polyline points;
    const glm::dvec2 inner = half - radius;
    for (int quarter = 0; quarter < 4; ++quarter) {
        const glm::dvec2 sign(quarter == 0 || quarter == 3 ? 1.0 : -1.0, quarter < 2 ? 1.0 : -1.0);
        for (int i = 0; i <= corner_segments; ++i) {
            const double share = corner_segments == 0 ? 0.5 : static_cast<double>(i) / corner_segments;
            const double angle = (quarter + share) * std::numbers::pi / 2.0;
            points.push_back(centre + sign * inner + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
        }
    }
    return points;
}

double area_of(const Shape& shape) {
    double area = 0.0;
    for (const Outline& outline : shape) {
        Polyline points;
        for (const Polyline& ring : outline.rings)
            points.insert(points.end(), ring.begin(), ring.end());
        for (const auto& [a, b, c] : outline.triangles) {
            const glm::dvec2 u = points[b] - points[a], v = points[c] - points[a];
            area += (u.x * v.y - u.y * v.x) / 2.0;
        }
    }
    return area;
}

Shape moved(Shape shape, const glm::dvec2& origin, double scale) {
    for (Outline& outline : shape) {
        for (Polyline& ring : outline.rings) {
            for (glm::dvec2& point : ring)
                point = origin + scale * point;
        }
    }
    return shape;
}

}  // namespace data
