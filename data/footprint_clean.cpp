// clean_rings and make_valid of footprint_shape.h.
#include <cmath>

#include "data/footprint_shape.h"

namespace data {

namespace {

constexpr double kSamePoint_m = 1e-3, kInLine_m = 1e-6, kMinArea_m2 = 0.01;

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// `point` adds nothing between its neighbours: it repeats one, lies on the line through them, or is a spike.
bool is_idle(const glm::dvec2& before, const glm::dvec2& point, const glm::dvec2& after) {
    const glm::dvec2 in = point - before, out = after - point, across = after - before;
    const double in_m = glm::length(in), out_m = glm::length(out), across_m = glm::length(across);
    if (in_m < kSamePoint_m || out_m < kSamePoint_m) return true;
    // The height of the triangle over its longest side.
    return std::abs(cross(in, out)) <= kInLine_m * std::fmax(across_m, std::fmax(in_m, out_m));
}

/// Drops idle points until none is left: dropping one can make its neighbours idle.
std::vector<glm::dvec2> clean_ring(std::vector<glm::dvec2> ring) {
    bool is_changed = true;
    while (is_changed && ring.size() >= 3) {
        is_changed = false;
        std::vector<glm::dvec2> kept;
        for (size_t i = 0; i < ring.size(); ++i) {
            const glm::dvec2& before = kept.empty() ? ring.back() : kept.back();
            const glm::dvec2& after = i + 1 < ring.size() ? ring[i + 1] : (kept.empty() ? ring[0] : kept[0]);
            if (is_idle(before, ring[i], after)) {
                is_changed = true;
            } else {
                kept.push_back(ring[i]);
            }
        }
        ring = std::move(kept);
    }
    if (ring.size() < 3) ring.clear();
    return ring;
}

bool is_valid(GEOSContextHandle_t context, const RingPolygon& polygon) {
    const GeosGeometryPtr geometry = geos_from_polygon(context, polygon);
    return geometry && GEOSisValid_r(context, geometry.get()) == 1;
}

}  // namespace

RingPolygon clean_rings(const RingPolygon& polygon) {
    RingPolygon result;
    for (size_t i = 0; i < polygon.rings.size(); ++i) {
        std::vector<glm::dvec2> ring = clean_ring(polygon.rings[i]);
        const double twice_area = twice_signed_area(ring);
        if (std::abs(twice_area) < 2.0 * kMinArea_m2) {
            if (i == 0) return {};
            continue;
        }
        const bool is_outer = i == 0;
        if ((twice_area > 0.0) != is_outer) ring = {ring.rbegin(), ring.rend()};
        result.rings.push_back(std::move(ring));
    }
    return result;
}

ValidPolygons make_valid(GEOSContextHandle_t context, const RingPolygon& polygon) {
    RingPolygon raw;
    for (const std::vector<glm::dvec2>& ring : polygon.rings) {
        if (ring.size() >= 3) raw.rings.push_back(ring);
    }
    ValidPolygons result;
    if (polygon.rings.empty() || polygon.rings[0].size() < 3) return result;
    result.is_repaired = !is_valid(context, raw);
    const RingPolygon clean = clean_rings(raw);
    if (!clean.rings.empty() && is_valid(context, clean)) {
        result.parts.push_back(clean);
        return result;
    }
    // A figure of eight has no signed area: what cleaning calls empty may still have parts.
    const GeosGeometryPtr broken = geos_from_polygon(context, raw);
    if (!broken) return result;
    const GeosGeometryPtr repaired(GEOSMakeValid_r(context, broken.get()), GeosGeometryCloser{context});
    if (!repaired) return result;
    std::vector<RingPolygon> parts;
    append_polygons(context, repaired.get(), parts);
    for (const RingPolygon& part : parts) {
        RingPolygon fit = clean_rings(part);
        if (!fit.rings.empty() && is_valid(context, fit)) result.parts.push_back(std::move(fit));
    }
    return result;
}

}  // namespace data
