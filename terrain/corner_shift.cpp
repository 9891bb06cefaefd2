#include "terrain/corner_shift.h"

#include <algorithm>

namespace terrain {
namespace {

/// A point of the triangle in the eye's frame, and its share of the first corner's way.
struct SharedPoint {
    glm::dvec3 eye{0.0};
    double share = 0.0;
};

/// A triangle that five planes have cut: each adds a corner at most.
struct Polygon {
    std::array<SharedPoint, 8> points;
    size_t count = 0;

    void add(const SharedPoint& point) { points[count++] = point; }
};

/// What lies at or above 0 along a plane.
/// @param height  of a point in the eye's frame, linear
template <typename Height>
Polygon clipped(const Polygon& polygon, const Height& height) {
    Polygon out;
    for (size_t i = 0; i < polygon.count; ++i) {
        const SharedPoint &from = polygon.points[i], &to = polygon.points[(i + 1) % polygon.count];
        const double from_height = height(from.eye), to_height = height(to.eye);
        if (from_height >= 0.0) out.add(from);
        if ((from_height >= 0.0) == (to_height >= 0.0)) continue;
        const double part = from_height / (from_height - to_height);
        out.add({glm::mix(from.eye, to.eye, part), glm::mix(from.share, to.share, part)});
    }
    return out;
}

/// The part that a view shows, or would if it lay up to `slack_m` elsewhere.
Polygon in_view(Polygon polygon, const lod::ViewMetric& metric, double slack_m) {
    const double slack_x = slack_m / metric.cos_x, slack_y = slack_m / metric.cos_y;
    polygon = clipped(polygon, [&](const glm::dvec3& p) { return -p.z - metric.near_m; });
    polygon = clipped(polygon, [&](const glm::dvec3& p) { return -p.z * metric.tan_x - p.x + slack_x; });
    polygon = clipped(polygon, [&](const glm::dvec3& p) { return -p.z * metric.tan_x + p.x + slack_x; });
    polygon = clipped(polygon, [&](const glm::dvec3& p) { return -p.z * metric.tan_y - p.y + slack_y; });
    return clipped(polygon, [&](const glm::dvec3& p) { return -p.z * metric.tan_y + p.y + slack_y; });
}

}  // namespace

double corner_shift_px(std::span<const lod::AnchoredEye> eyes, const std::array<glm::vec3, 3>& corners,
                       const glm::vec3& way_m) {
    const double length_m = static_cast<double>(glm::length(way_m));
    if (length_m == 0.0) return 0.0;
    double worst_px = 0.0;
    for (const lod::AnchoredEye& eye : eyes) {
        Polygon triangle;
        for (size_t i = 0; i < 3; ++i) {
            triangle.add(
                {eye.metric.eye_from_world * (glm::dvec3(corners[i]) - eye.eye), i == 0 ? 1.0 : 0.0});
        }
        const Polygon seen = in_view(triangle, eye.metric, length_m);
        double slant = 0.0, ratio = 0.0;
        for (size_t i = 0; i < seen.count; ++i) {
            const SharedPoint& point = seen.points[i];
            const double depth_m = -point.eye.z, way = length_m * point.share;
            slant = std::max(slant, glm::length(point.eye) / depth_m);
            ratio = std::max(ratio, way / std::max(depth_m - way, eye.metric.near_m));
        }
        worst_px = std::max(worst_px, eye.metric.lambda_px * slant * ratio);
    }
    return worst_px;
}

}  // namespace terrain
