#include "lod/eye_odometer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lod {
namespace {

/// Readings are floats in the records: they start again before a millimetre is lost, or a ten-thousandth of where eyes
/// usually are.
constexpr double kLimit = 4096.0, kTypicalLimit = 128.0;

/// Chord of the rotation between two orientations: moves a point at distance 1 by at most this.
double rotation_chord(const glm::dmat3& a, const glm::dmat3& b) {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i)
        sum += glm::dot(a[i] - b[i], a[i] - b[i]);
    return std::sqrt(sum / 2.0);
}

bool has_same_optics(const ViewMetric& a, const ViewMetric& b) {
    return a.lambda_px == b.lambda_px && a.tan_x == b.tan_x && a.tan_y == b.tan_y && a.near_m == b.near_m;
}

}  // namespace

EyeOdometer::Step EyeOdometer::advance(std::span<const View> views, const glm::dvec3& anchor_world) {
    bool is_comparable = views.size() == eyes_.size();
    step_m_ = step_rad_ = 0.0;
    eyes_before_ = eyes_;
    for (size_t i = 0; i < views.size(); ++i) {
        const AnchoredEye now(views[i], anchor_world);
        if (i == eyes_.size()) {
            eyes_.push_back(now);
            continue;
        }
        const AnchoredEye then = std::exchange(eyes_[i], now);
        is_comparable = is_comparable && has_same_optics(now.metric, then.metric);
        step_m_ = std::max(step_m_, glm::length(now.eye - then.eye));
        step_rad_ =
            std::max(step_rad_, rotation_chord(now.metric.eye_from_world, then.metric.eye_from_world));
    }
    eyes_.erase(eyes_.begin() + static_cast<std::ptrdiff_t>(views.size()), eyes_.end());
    walked_m_ += step_m_;
    turned_rad_ += step_rad_;
    walk_share_ =
        static_cast<float>(std::clamp(step_m_ / (step_m_ + typical_m_ * step_rad_ + 1e-30), 0.1, 0.9));
    if (is_comparable && walked_m_ < std::min(kLimit, kTypicalLimit * typical_m_) && turned_rad_ < kLimit)
        return Step::kAdvanced;
    walked_before_m_ = std::exchange(walked_m_, 0.0);
    turned_before_rad_ = std::exchange(turned_rad_, 0.0);
    return is_comparable ? Step::kRewound : Step::kIncomparable;
}

}  // namespace lod
