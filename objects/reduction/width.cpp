#include "objects/reduction/width.h"

#include "objects/reduction/seen_part.h"

namespace objects {

namespace {

constexpr int kTurns = 8;            ///< of a normal towards the least spread
constexpr double kFirstTurn = 0.25;  ///< radians, of the search from there …
constexpr double kNextShare = 0.8;   ///< … each of the last
constexpr int kSearches = 16;

/// Across the plane that fits best. Source: inverse iteration, with a little of the identity for what is flat.
glm::dvec3 short_axis(std::span<const glm::dvec3> points) {
    const glm::dmat3 spread = spread_about_mean(points);
    const double size = spread[0][0] + spread[1][1] + spread[2][2];
    glm::dvec3 axis(0, 0, 1);
    if (!(size > 0.0)) return axis;
    const glm::dmat3 inverse = glm::inverse(spread / size + glm::dmat3(1e-6));
    for (int turn = 0; turn < kTurns; ++turn)
        axis = glm::normalize(inverse * axis + glm::dvec3(1e-9, 2e-9, 0.0));
    return axis;
}

}  // namespace

double least_width_m(std::span<const glm::dvec3> points) {
    glm::dvec3 normal = short_axis(points);
    double least_m = 0.0, turn = kFirstTurn;
    for (int search = 0; search <= kSearches; ++search, turn *= kNextShare) {
        const glm::dvec3 *first = &points[0], *last = first;
        for (const glm::dvec3& point : points) {
            if (glm::dot(normal, point - *first) < 0.0) first = &point;
            if (glm::dot(normal, point - *last) > 0.0) last = &point;
        }
        const glm::dvec3 way = *last - *first;
        const double width_m = glm::dot(normal, way);
        if (search == 0 || width_m < least_m) least_m = width_m;
        const glm::dvec3 aside = way - width_m * normal;  // turned from there, both come nearer
        const double length = glm::length(aside);
        if (!(length > 0.0)) break;
        normal = glm::normalize(normal - turn / length * aside);
    }
    return least_m;
}

}  // namespace objects
