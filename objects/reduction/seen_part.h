// SeenPart: a part of a soup seen along an axis, as what is nearly a prism is described.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "objects/reduction/outline.h"

namespace objects {

/// Metres along three axes of the part's own, the third what it is seen along.
struct SeenPart {
    glm::dmat3 part_from_axes{1.0};    ///< third column: the axis
    double low_m = 0.0, high_m = 0.0;  ///< along the axis
    Outline outline, rectangle;        ///< seen along it: the hull, and the least rectangle around

    double height_m() const { return high_m - low_m; }
    glm::dvec3 at(const glm::dvec2& place, double z_m) const {
        return part_from_axes * glm::dvec3(place.x, place.y, z_m);
    }
};

/// @param points  at least one
/// @param axis    of length 1
/// Cost: O(n log n).
SeenPart see_along(std::span<const glm::dvec3> points, const glm::dvec3& axis);

/// The sum over points, at least one, of the outer product of what they are off their mean by; m^2.
glm::dmat3 spread_about_mean(std::span<const glm::dvec3> points);

/// Along which points are spread most, of length 1; upwards where all are one. Source: the power method.
glm::dvec3 long_axis(std::span<const glm::dvec3> points);

inline constexpr double kSlender =
    4.0;  ///< so many breadths long: what would vanish, seen from the edge of a single face

/// Whether points, at least one, lie along a line: a mast, perhaps of several parts.
bool is_rod(std::span<const glm::dvec3> points);

/// Along the rectangle's longer side, through its middle.
struct Line {
    glm::dvec2 middle{0.0}, half{0.0};
};
Line long_line(const Outline& rectangle);

double short_side_m(const Outline& rectangle);

/// Points of a prism over the outline that speak for its surface: rings of at most twelve corners, as many one over the other
/// as keep them `step_m` apart, and inner rings and a middle above and below.
std::vector<glm::dvec3> prism_samples(const SeenPart& seen, double step_m);

}  // namespace objects
