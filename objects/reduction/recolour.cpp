#include "objects/reduction/recolour.h"

#include <algorithm>
#include <cmath>

namespace objects {

namespace {

constexpr double kLeastCosine = 0.5;  // 60 degrees: what faces elsewhere is seen from elsewhere

/// Twice the area, along the normal.
glm::dvec3 area_vector(const lod::Triangle& t) {
    return glm::cross(t.b - t.a, t.c - t.a);
}

glm::dvec3 light_of(const glm::u8vec4& colour) {
    const glm::dvec3 c(colour.x, colour.y, colour.z);
    return c * c;
}

/// Colours that meet on a face, by area.
struct Mixture {
    glm::dvec3 light{0.0};
    double weight = 0.0;
};

}  // namespace

void recolour(const FaceSoup& source, const NearestFaces& nearest, FaceSoup& result) {
    std::vector<Mixture> mixtures(result.faces.size());
    std::vector<glm::dvec3> across(result.faces.size());
    for (size_t face = 0; face < result.faces.size(); ++face)
        across[face] = area_vector(result.view().triangle(face));
    for (size_t face = 0; face < source.faces.size(); ++face) {
        if (source.colours[face].w < 255) continue;
        const lod::Triangle triangle = source.view().triangle(face);
        const glm::dvec3 area = area_vector(triangle);
        const double size = glm::length(area);
        for (const uint32_t near : nearest[face]) {
            if (near == kNoFace || result.colours[near].w < 255) continue;
            const glm::dvec3& onto = across[near];
            if (std::abs(glm::dot(area, onto)) < kLeastCosine * size * glm::length(onto)) continue;
            mixtures[near].light += size * light_of(source.colours[face]);
            mixtures[near].weight += size;
        }
    }
    for (size_t face = 0; face < result.faces.size(); ++face) {
        if (!(mixtures[face].weight > 0.0)) continue;
        const glm::dvec3 mean = glm::sqrt(mixtures[face].light / mixtures[face].weight);
        const glm::u8vec3 mixed(glm::clamp(glm::round(mean), 0.0, 255.0));
        result.colours[face] = {mixed.x, mixed.y, mixed.z, 255};
    }
}

}  // namespace objects
