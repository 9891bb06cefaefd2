#include "objects/reduction/upper_side.h"

#include <utility>

#include "objects/reduction/parts.h"

namespace objects {

namespace {

constexpr double kSteepSine = 0.3;  ///< what looks down less than that is a wall

}  // namespace

void turn_open_parts_up(double cell_m, FaceSoup& soup) {
    const WeldedSoup welded = weld(soup, cell_m);
    for (const auto& part : parts_of(soup, welded.point_of, welded.soup.points.size())) {
        if (is_closed(soup, part, welded.point_of)) continue;
        for (const uint32_t face : part) {
            auto& [a, b, c] = soup.faces[face];
            const glm::dvec3 one = soup.points[b] - soup.points[a], other = soup.points[c] - soup.points[a];
            const glm::dvec3 normal = glm::cross(one, other);
            if (normal.z < -kSteepSine * glm::length(normal)) std::swap(b, c);
        }
    }
}

}  // namespace objects
