#include "objects/reduction/twisted_card.h"

#include <cmath>

namespace objects {

std::array<glm::dvec3, 4> twisted_card(const Rod& rod) {
    const glm::dvec3 other = std::abs(rod.axis.z) < 0.7 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 one_way = 0.5 * rod.breadth_m * glm::normalize(glm::cross(rod.axis, other));
    const glm::dvec3 other_way = glm::cross(rod.axis, one_way);
    const glm::dvec3 half = 0.5 * rod.length_m * rod.axis;
    const glm::dvec3 from = rod.middle - half, to = rod.middle + half;
    return {from - one_way, from + one_way, to - other_way, to + other_way};
}

void append_card(const std::array<glm::dvec3, 4>& corners, const glm::u8vec4& colour, FaceSoup& out) {
    const uint32_t first = static_cast<uint32_t>(out.points.size());
    out.points.insert(out.points.end(), corners.begin(), corners.end());
    for (uint32_t begin : {0u, 1u}) {
        out.faces.push_back({first + begin, first + begin + 1, first + begin + 2});
        out.colours.push_back(colour);
    }
}

}  // namespace objects
