#include "lod/progressive/error_proof.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lod {

ErrorProof::ErrorProof(std::span<const glm::vec3> leaves, std::span<const std::array<NodeId, 3>> triangles)
    : image_(leaves, triangles), errors_m_(leaves.size(), 0.0f) {
    double largest = 0.0;
    for (const glm::vec3& p : leaves)
        largest = std::max({largest, std::abs(double(p.x)), std::abs(double(p.y)), std::abs(double(p.z))});
    noise_m_ = largest * 0x1p-40;
}

float ErrorProof::take(const CollapseStep& step) {
    const float least_m = std::max(errors_m_[step.children[0]], errors_m_[step.children[1]]);
    const double bound = image_.collapse(step, double(least_m));
    float error_m = static_cast<float>(bound);
    if (double(error_m) < bound) error_m = std::nextafter(error_m, std::numeric_limits<float>::max());
    errors_m_.push_back(std::max(least_m, bound > noise_m_ ? error_m : 0.0f));
    return errors_m_.back();
}

}  // namespace lod
