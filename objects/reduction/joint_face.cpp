#include "objects/reduction/joint_face.h"

namespace objects {

using lod::Triangle;

Triangle largest_face(const std::array<glm::dvec3, 6>& corners) {
    Triangle largest;
    double most = -1.0;
    for (size_t i = 0; i < 6; ++i) {
        for (size_t k = i + 1; k < 6; ++k) {
            for (size_t l = k + 1; l < 6; ++l) {
                const glm::dvec3 cross = glm::cross(corners[k] - corners[i], corners[l] - corners[i]);
                if (glm::dot(cross, cross) <= most) continue;
                most = glm::dot(cross, cross);
                largest = {corners[i], corners[k], corners[l]};
            }
        }
    }
    return largest;
}

Triangle narrow_face(const std::array<glm::dvec3, 6>& corners) {
    Triangle face;
    double most = -1.0;
    for (size_t i = 0; i < 6; ++i) {
        for (size_t k = i + 1; k < 6; ++k) {
            const double apart2 = lod::squared_distance(corners[i], corners[k]);
            if (apart2 > most) most = apart2, face.a = corners[i], face.b = corners[k];
        }
    }
    most = -1.0;
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 near = lod::nearest_on_segment(corner, face.a, face.b);
        const double off2 = lod::squared_distance(corner, near);
        if (off2 > most) most = off2, face.c = 0.5 * (corner + near);
    }
    return face;
}

}  // namespace objects
