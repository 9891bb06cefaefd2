// triangulate of footprint_shape.h.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "data/footprint_shape.h"

namespace data {

namespace {

/// The ring points in order, findable by their exact coordinates.
class PointIndex {
  public:
    explicit PointIndex(const RingPolygon& polygon) {
        for (const std::vector<glm::dvec2>& ring : polygon.rings) {
            for (const glm::dvec2& point : ring)
                points_.push_back({point.x, point.y, static_cast<uint32_t>(points_.size())});
        }
        std::sort(points_.begin(), points_.end());
        is_used_.assign(points_.size(), false);
    }

    std::optional<uint32_t> use(const glm::dvec2& point) {
        const Entry wanted{point.x, point.y, 0};
        const auto at = std::lower_bound(points_.begin(), points_.end(), wanted);
        if (at == points_.end() || !coincide(*at, wanted)) return std::nullopt;
        is_used_[static_cast<size_t>(at - points_.begin())] = true;
        return at->index;
    }

    /// Points that coincide count once.
    bool all_used() const {
        for (size_t i = 0; i < points_.size(); ++i) {
            if (!is_used_[i] && (i == 0 || !coincide(points_[i], points_[i - 1]))) return false;
        }
        return true;
    }

  private:
    struct Entry {
        double x, y;
        uint32_t index;
        auto operator<=>(const Entry&) const = default;
    };
    static bool coincide(const Entry& a, const Entry& b) { return a.x == b.x && a.y == b.y; }
    std::vector<Entry> points_;
    std::vector<bool> is_used_;
};

/// `point` lies between a and b on their segment, ends excluded.
bool is_on_edge(const glm::dvec2& point, const glm::dvec2& a, const glm::dvec2& b) {
    constexpr double kTouch_m = 1e-9;
    const glm::dvec2 edge = b - a, way = point - a;
    const double length_m = glm::length(edge), along_m = glm::dot(way, edge) / length_m;
    const double off_m = std::abs(edge.x * way.y - edge.y * way.x) / length_m;
    return off_m <= kTouch_m && along_m > kTouch_m && along_m < length_m - kTouch_m;
}

/// The polygon with the corners of each ring that touch another ring's edge made points of that ring too.
RingPolygon with_touching_points(const RingPolygon& polygon) {
    RingPolygon result;
    for (const std::vector<glm::dvec2>& ring : polygon.rings) {
        std::vector<glm::dvec2>& noded = result.rings.emplace_back();
        for (size_t i = 0; i < ring.size(); ++i) {
            const glm::dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
            std::vector<glm::dvec2> touching;
            for (const std::vector<glm::dvec2>& other : polygon.rings) {
                std::copy_if(other.begin(), other.end(), std::back_inserter(touching),
                             [&](const glm::dvec2& point) { return is_on_edge(point, a, b); });
            }
            std::sort(touching.begin(), touching.end(), [a](const glm::dvec2& p, const glm::dvec2& q) {
                return glm::distance(a, p) < glm::distance(a, q);
            });
            touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
            noded.push_back(a);
            noded.insert(noded.end(), touching.begin(), touching.end());
        }
    }
    return result;
}

/// The triangles GEOS makes of `traced`, on the points of `polygon`, which has the same area.
Triangles triangles_of(GEOSContextHandle_t context, const RingPolygon& polygon, const RingPolygon& traced) {
    const GeosGeometryPtr geometry = geos_from_polygon(context, traced);
    if (!geometry) return {};
    const GeosGeometryPtr cover(GEOSConstrainedDelaunayTriangulation_r(context, geometry.get()),
                                GeosGeometryCloser{context});
    if (!cover) return {};
    std::vector<RingPolygon> faces;
    append_polygons(context, cover.get(), faces);

    PointIndex points(polygon);
    Triangles triangles;
    double covered_m2 = 0.0;
    for (const RingPolygon& face : faces) {
        const std::vector<glm::dvec2>& ring = face.rings[0];
        if (face.rings.size() != 1 || ring.size() != 3) return {};
        const std::optional<uint32_t> a = points.use(ring[0]), b = points.use(ring[1]),
                                      c = points.use(ring[2]);
        if (!a || !b || !c) return {};
        const double twice_area = twice_signed_area(ring);
        covered_m2 += 0.5 * std::abs(twice_area);
        triangles.push_back(twice_area > 0.0 ? std::array{*a, *b, *c} : std::array{*a, *c, *b});
    }
    const double area_m2 = area_of(polygon);
    if (std::abs(covered_m2 - area_m2) > 1e-9 * area_m2 || !points.all_used()) return {};
    return triangles;
}

}  // namespace

Triangles triangulate(GEOSContextHandle_t context, const RingPolygon& polygon) {
    Triangles triangles = triangles_of(context, polygon, polygon);
    // GEOS loses its way where a corner of one ring touches the middle of another's edge.
    if (triangles.empty()) triangles = triangles_of(context, polygon, with_touching_points(polygon));
    return triangles;
}

}  // namespace data
