#include "objects/facing_ranges.h"

#include <cmath>

namespace objects {

namespace {

constexpr uint32_t kShortGap = 12;    ///< indices: what one command more costs
constexpr double kSlackShare = 1e-5;  ///< of the distance: positions are rounded when they are drawn

}  // namespace

bool looks_away(const FacingRange& range, const glm::dvec3& eye) {
    const double distance_m = glm::length(eye);
    const double along_m = glm::dot(glm::dvec3(range.axis), eye);
    const double across_m = std::sqrt(std::max(distance_m * distance_m - along_m * along_m, 0.0));
    const double cos = double(range.spread_cos), sin = std::sqrt(std::max(1.0 - cos * cos, 0.0));
    if (along_m >= distance_m * cos) return false;  // some normal may point right at the eye
    // The largest of dot(normal, eye) over the cone of normals.
    return along_m * cos + across_m * sin < double(range.least_offset_m) - kSlackShare * distance_m;
}

void visible_spans(const ClusterTree& tree, const ClusterGeometry& geometry, const glm::dvec3& eye_geometry,
                   double clear_m, std::vector<IndexSpan>& out) {
    const uint32_t opaque = geometry.index_count - geometry.glass_index_count;
    const glm::dvec3 eye = eye_geometry - glm::dvec3(geometry.centre);
    if (geometry.facing_count == 0 || glm::length(eye) <= double(geometry.radius_m) + clear_m) {
        if (opaque > 0) out.push_back({0, opaque});
        return;
    }
    const size_t before = out.size();
    uint32_t first = 0;
    for (uint32_t i = 0; i < geometry.facing_count; ++i) {
        const FacingRange& range = tree.facings[geometry.first_facing + i];
        if (!looks_away(range, eye)) {
            const bool joins =
                out.size() > before && first - (out.back().first + out.back().count) <= kShortGap;
            if (joins)
                out.back().count = first + range.index_count - out.back().first;
            else
                out.push_back({first, range.index_count});
        }
        first += range.index_count;
    }
}

}  // namespace objects
