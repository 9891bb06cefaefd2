#include "objects/reduction/recolour.h"

#include <algorithm>
#include <cmath>

#include "lod/surface/triangle_tree.h"

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

/// The points that speak for a face: the middles of the four triangles its edges' middles cut it into.
std::array<glm::dvec3, 4> quarters(const lod::Triangle& t) {
    const glm::dvec3 middle = (t.a + t.b + t.c) / 3.0;
    return {middle, (middle + t.a) * 0.5, (middle + t.b) * 0.5, (middle + t.c) * 0.5};
}

}  // namespace

void recolour(const FaceSoup& source, double limit_m, FaceSoup& result) {
    std::vector<Mixture> mixtures(result.faces.size());
    std::vector<glm::dvec3> across(result.faces.size());
    for (size_t face = 0; face < result.faces.size(); ++face)
        across[face] = area_vector(result.view().triangle(face));
    const lod::TriangleTree tree(result.view());
    for (size_t face = 0; face < source.faces.size(); ++face) {
        if (source.colours[face].w < 255) continue;
        const lod::Triangle triangle = source.view().triangle(face);
        const glm::dvec3 area = area_vector(triangle);
        const double size = glm::length(area);
        for (const glm::dvec3& point : quarters(triangle)) {
            const lod::TriangleHit hit = tree.nearest(point, limit_m);
            if (hit.triangle >= mixtures.size() || result.colours[hit.triangle].w < 255) continue;
            const glm::dvec3& onto = across[hit.triangle];
            if (std::abs(glm::dot(area, onto)) < kLeastCosine * size * glm::length(onto)) continue;
            mixtures[hit.triangle].light += size * light_of(source.colours[face]);
            mixtures[hit.triangle].weight += size;
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
