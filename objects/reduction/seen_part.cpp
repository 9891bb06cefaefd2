#include "objects/reduction/seen_part.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace objects {

namespace {

constexpr int kTurns = 24;  ///< of an axis towards the longest
constexpr int kRingSamples = 12;
constexpr int kMostRings = 8;

}  // namespace

SeenPart see_along(std::span<const glm::dvec3> points, const glm::dvec3& axis) {
    SeenPart seen;
    const glm::dvec3 other = std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(other, axis));
    seen.part_from_axes = glm::dmat3(right, glm::cross(axis, right), axis);
    const glm::dmat3 axes_from_part = glm::transpose(seen.part_from_axes);
    std::vector<glm::dvec2> flat;
    flat.reserve(points.size());
    for (const glm::dvec3& point : points) {
        const glm::dvec3 at = axes_from_part * point;
        seen.low_m = flat.empty() ? at.z : std::min(seen.low_m, at.z);
        seen.high_m = flat.empty() ? at.z : std::max(seen.high_m, at.z);
        flat.emplace_back(at.x, at.y);
    }
    seen.outline = convex_outline(flat);
    seen.rectangle = least_rectangle(seen.outline);
    return seen;
}

Line long_line(const Outline& rectangle) {
    if (rectangle.size() < 4)
        return {0.5 * (rectangle.front() + rectangle.back()), 0.5 * (rectangle.back() - rectangle.front())};
    const glm::dvec2 one = 0.5 * (rectangle[1] - rectangle[0]), other = 0.5 * (rectangle[2] - rectangle[1]);
    return {0.5 * (rectangle[0] + rectangle[2]), glm::length(one) < glm::length(other) ? other : one};
}

double short_side_m(const Outline& rectangle) {
    if (rectangle.size() < 4) return 0.0;
    return std::min(glm::distance(rectangle[0], rectangle[1]), glm::distance(rectangle[1], rectangle[2]));
}

glm::dmat3 spread_about_mean(std::span<const glm::dvec3> points) {
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& point : points)
        middle += point / static_cast<double>(points.size());
    glm::dmat3 spread(0.0);
    for (const glm::dvec3& point : points)
        spread += glm::outerProduct(point - middle, point - middle);
    return spread;
}

glm::dvec3 long_axis(std::span<const glm::dvec3> points) {
    const glm::dmat3 spread = spread_about_mean(points);
    glm::dvec3 axis(spread[0][0] + 1e-12, spread[1][1] + 1e-12, spread[2][2] + 1e-12);
    for (int turn = 0; turn < kTurns; ++turn) {
        axis = spread * axis;
        const double size = glm::length(axis);
        if (!(size > 0.0)) return glm::dvec3(0, 0, 1);
        axis /= size;
    }
    return axis;
}

bool is_rod(std::span<const glm::dvec3> points) {
    const glm::dvec3 axis = long_axis(points);
    double first_m = std::numeric_limits<double>::infinity(), last_m = -first_m;
    glm::dvec3 low(first_m), high(-first_m);  // across the axis
    for (const glm::dvec3& point : points) {
        const double along_m = glm::dot(axis, point);
        first_m = std::min(first_m, along_m);
        last_m = std::max(last_m, along_m);
        low = glm::min(low, point - along_m * axis);
        high = glm::max(high, point - along_m * axis);
    }
    return last_m - first_m >= kSlender * glm::length(high - low);
}

std::vector<glm::dvec3> prism_samples(const SeenPart& seen, double step_m) {
    const glm::dvec2 middle = long_line(seen.rectangle).middle;
    Outline ring;
    for (int i = 0; i < kRingSamples; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kRingSamples;
        const glm::dvec2 way(std::cos(angle), std::sin(angle));
        const auto farthest = std::max_element(
            seen.outline.begin(), seen.outline.end(),
            [&](const glm::dvec2& a, const glm::dvec2& b) { return glm::dot(a, way) < glm::dot(b, way); });
        if (ring.empty() || ring.back() != *farthest) ring.push_back(*farthest);
    }
    const int rings = std::clamp(static_cast<int>(std::ceil(seen.height_m() / step_m)), 1, kMostRings);
    std::vector<glm::dvec3> samples;
    for (int i = 0; i <= rings; ++i) {
        const double z_m = seen.low_m + seen.height_m() * i / rings;
        for (const glm::dvec2& corner : ring)
            samples.push_back(seen.at(corner, z_m));
        if (i > 0 && i < rings) continue;
        samples.push_back(seen.at(middle, z_m));
        for (const glm::dvec2& corner : ring)
            samples.push_back(seen.at(0.5 * (middle + corner), z_m));
    }
    return samples;
}

}  // namespace objects
