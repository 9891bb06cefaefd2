#include "lod/progressive/error_proof.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lod/progressive/surface_image.h"

namespace lod {

void prove_errors(VertexHierarchy& h) {
    double largest = 0.0;
    for (const glm::vec3& p : h.position)
        largest = std::max({largest, std::abs(double(p.x)), std::abs(double(p.y)), std::abs(double(p.z))});
    const double noise = largest * 0x1p-40;
    h.error_m.assign(h.node_count(), 0.0f);
    SurfaceImage image(std::span(h.position).first(h.leaf_count), h.triangles);
    for (uint32_t k = 0; k < h.collapse_count(); ++k) {
        const auto [a, b] = h.children[k];
        const double bound = image.collapse(step_of(h, k), double(std::max(h.error_m[a], h.error_m[b])));
        float error_m = static_cast<float>(bound);
        if (double(error_m) < bound) error_m = std::nextafter(error_m, std::numeric_limits<float>::max());
        h.error_m[h.leaf_count + k] = std::max({h.error_m[a], h.error_m[b], bound > noise ? error_m : 0.0f});
    }
}

}  // namespace lod
