// Triangle: three points, and the point of it that is nearest to another.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace lod {

/// Any three points, in any order; collapsed ones are segments or points.
struct Triangle {
    glm::dvec3 a{0.0}, b{0.0}, c{0.0};
};

/// A polygon soup: triangles over shared points. No topology is assumed.
struct Soup {
    std::span<const glm::dvec3> points;                  ///< metres, finite
    std::span<const std::array<uint32_t, 3>> triangles;  ///< into points

    Triangle triangle(size_t i) const {
        const auto& [a, b, c] = triangles[i];
        return {points[a], points[b], points[c]};
    }
};

/// The nearest point of a segment. Exact to rounding for segments of any length, zero included.
inline glm::dvec3 nearest_on_segment(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double length2 = glm::dot(along, along);
    if (!(length2 > 0.0)) return a;
    const double share = glm::dot(point - a, along) / length2;
    if (share <= 0.0) return a;
    if (share >= 1.0) return b;
    return a + share * along;
}

/// The nearest point of a triangle. Whatever rounding does to its choice, what it returns lies in the triangle, so
/// its distance is never less than the true one but for the rounding of one subtraction.
/// Source: Ericson, Real-time collision detection (2005), 5.1.5. Differs from it in: collapsed triangles are segments.
glm::dvec3 nearest_on_triangle(const glm::dvec3& point, const Triangle& triangle);

/// Along the normal that its corners turn about.
inline glm::dvec3 area_vector_m2(const Triangle& t) {
    return 0.5 * glm::cross(t.b - t.a, t.c - t.a);
}
inline double area_m2(const Triangle& t) {
    return 0.5 * glm::length(glm::cross(t.b - t.a, t.c - t.a));
}

inline double squared_distance(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::dot(a - b, a - b);
}
inline double squared_distance(const glm::dvec3& point, const Triangle& triangle) {
    return squared_distance(point, nearest_on_triangle(point, triangle));
}

/// The same triangle with its longest edge from a to b: where it is halved.
inline Triangle turn_longest_first(const Triangle& t) {
    const double ab = squared_distance(t.a, t.b), bc = squared_distance(t.b, t.c),
                 ca = squared_distance(t.c, t.a);
    if (ab >= bc && ab >= ca) return t;
    return bc >= ca ? Triangle{t.b, t.c, t.a} : Triangle{t.c, t.a, t.b};
}

}  // namespace lod
