#include "objects/reduction/nearest_faces.h"

#include "lod/surface/triangle_tree.h"

namespace objects {

std::array<glm::dvec3, 4> quarters(const lod::Triangle& t) {
    const glm::dvec3 middle = (t.a + t.b + t.c) / 3.0;
    return {middle, (middle + t.a) * 0.5, (middle + t.b) * 0.5, (middle + t.c) * 0.5};
}

NearestFaces nearest_faces(const FaceSoup& source, const FaceSoup& result, double limit_m) {
    const lod::TriangleTree tree(result.view());
    NearestFaces nearest(source.faces.size());
    for (size_t face = 0; face < source.faces.size(); ++face) {
        const std::array<glm::dvec3, 4> points = quarters(source.view().triangle(face));
        for (size_t i = 0; i < points.size(); ++i) {
            const lod::TriangleHit hit = tree.nearest(points[i], limit_m);
            nearest[face][i] = hit.triangle < result.faces.size() ? hit.triangle : kNoFace;
        }
    }
    return nearest;
}

}  // namespace objects
