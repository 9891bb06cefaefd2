// Upright prisms as soups for tests.
#pragma once

#include "objects/reduction/face_soup.h"
#include "tests/bench/prism_city.h"

namespace objects_test {

inline objects::FaceSoup prism(uint32_t sides, double radius_m, double height_m, const glm::dvec3& foot = {},
                               const glm::u8vec4& colour = {200, 180, 160, 255}) {
    const data::TimedMesh mesh = bench::upright_prism(sides, radius_m, height_m, 0.3, colour);
    objects::FaceSoup soup;
    for (const glm::vec3& position : mesh.positions)
        soup.points.push_back(glm::dvec3(position) + foot);
    soup.faces = mesh.triangles;
    soup.colours.assign(soup.faces.size(), colour);
    return soup;
}

}  // namespace objects_test
