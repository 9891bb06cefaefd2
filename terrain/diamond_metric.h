// Screen error of a diamond, and how far the eye may move before its bucket can change.
//
// The lazy part of the queues. An evaluation says not only "2.3 px" but also "and it stays in its bucket until a
// point of the diamond has moved by g metres in the eye frame". Eye motion is summed up in two odometers (metres
// and radians); a diamond sleeps until they have gone far enough. So the cost of a frame follows the motion, not
// the size of the mesh.
//
// The bound is p = lambda e (d + r) / f^2 with f the depth of the sphere's near side. Its logarithm changes by at
// most sqrt(4 - 3 q^2) / f per metre, q = f / (d + r): between 1/f straight ahead and 2/f at the side. While the
// eye moves by less than 0.06 f, q shrinks by less than 12 %, hence the 2.3 below.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "lod/screen_error.h"
#include "terrain/bucket_queue.h"
#include "terrain/diamond_bound.h"

namespace terrain {

/// One evaluation.
struct Evaluation {
    Bucket bucket = kHiddenBucket;
    float error_px = 0.0f;    ///< upper bound; 0 when no eye sees it
    float guard_m = 0.0f;     ///< displacement in the eye frame that keeps the statement true
    float distance_m = 0.0f;  ///< from the nearest eye to the centre
};

/// One eye, ready for loops: the view's metric in single precision, the eye relative to the terrain's anchor.
struct AnchoredEye {
    explicit AnchoredEye(const lod::View& view, const glm::dvec3& anchor)
        : metric(lod::metric_of(view)),
          eye(view.eye_world - anchor),
          eye_f(eye),
          rotation(glm::mat3(view.eye_from_world)),
          tan_x(static_cast<float>(metric.tan_x)),
          tan_y(static_cast<float>(metric.tan_y)),
          cos_x(static_cast<float>(metric.cos_x)),
          cos_y(static_cast<float>(metric.cos_y)),
          inverse_stretch(static_cast<float>(1.0 / metric.stretch)),
          stretch(static_cast<float>(metric.stretch)),
          near_m(static_cast<float>(metric.near_m)),
          // 2^-18 covers the roundings of the few operations below.
          lambda_px(static_cast<float>(metric.lambda_px * (1.0 + 0x1p-18))) {}

    lod::ViewMetric metric;
    glm::dvec3 eye;
    glm::vec3 eye_f;
    glm::mat3 rotation;
    float tan_x, tan_y, cos_x, cos_y, inverse_stretch, stretch, near_m, lambda_px;

    glm::vec3 to_eye(const glm::vec3& anchored) const { return rotation * (anchored - eye_f); }

    /// lod::distance_outside_m in single precision; `centre` in the eye frame.
    float distance_outside_m(const glm::vec3& centre, float radius) const {
        const float x = (std::abs(centre.x) + centre.z * tan_x) * cos_x;
        const float y = (std::abs(centre.y) + centre.z * tan_y) * cos_y;
        return std::max(std::max(x, y), near_m + centre.z) - radius;
    }
};

/// What is about to cross an edge counts as beyond it, and what is about to come into view as seen: otherwise a
/// diamond that creeps up to an edge would wake in ever shorter steps.
inline constexpr float kEdgeMargin = 0.03f;   ///< of the error
inline constexpr float kSightMargin = 0.01f;  ///< of the distance

/// How far the error may fall before the statement ends, too: wanted for diamonds that could be merged.
enum class Watch : uint8_t { kRise, kRiseAndFall };

/// Screen error of a sphere and the depth at which it was taken: lod::screen_error_px in single precision.
struct DepthError {
    float error_px = 0.0f;
    float depth_m = 0.0f;
    float step_m = 0.0f;  ///< moving by x * step_m, x <= 0.06, changes error_px by a factor of at most 1 + x
};
inline DepthError depth_error(const AnchoredEye& eye, const DiamondBound& bound, const glm::vec3& centre,
                              float distance) {
    const float front = -centre.z - bound.radius_m;
    const float depth =
        std::max(std::max(front, (distance - bound.radius_m) * eye.inverse_stretch), eye.near_m);
    const float slant = std::min(eye.stretch, (distance + bound.radius_m) / std::max(front, eye.near_m));
    // 1 / sqrt(4 - 2.3 q^2) >= 1/2 + q^2 / 7: a tangent, and safe.
    const float q = std::min(depth / (distance + bound.radius_m), 1.0f);
    return {eye.lambda_px * bound.error_m * std::max(slant, 1.0f) / depth, depth,
            depth * (0.5f + q * q * (1.0f / 7.0f))};
}

inline Evaluation evaluate(const DiamondBound& bound, std::span<const AnchoredEye> eyes,
                           const BucketScale& scale, Watch watch) {
    constexpr float kFar = 1e30f;
    Evaluation result;
    float worst_px = -1.0f;  // negative: no eye sees it
    float hidden_m = kFar;   // how far it must move until one more eye sees it
    float seen_m = -1.0f;    // how far until the last eye has lost it
    float nearest = kFar, depth = kFar, step = kFar;
    for (const AnchoredEye& eye : eyes) {
        const glm::vec3 centre = eye.to_eye(bound.centre);
        const float outside = eye.distance_outside_m(centre, bound.radius_m);
        const float distance = std::sqrt(glm::dot(centre, centre));
        nearest = std::min(nearest, distance);
        const float margin = kSightMargin * distance;
        if (outside > margin) {
            hidden_m = std::min(hidden_m, outside);
            continue;
        }
        seen_m = std::max(seen_m, margin - outside);
        const DepthError here = depth_error(eye, bound, centre, distance);
        worst_px = std::max(worst_px, here.error_px);
        if (outside <= 0.0f) result.error_px = std::max(result.error_px, here.error_px);
        depth = std::min(depth, here.depth_m);
        step = std::min(step, here.step_m);
    }
    result.guard_m = hidden_m;
    result.distance_m = nearest;
    if (worst_px < 0.0f) return result;
    const bool watches_fall = watch == Watch::kRiseAndFall;
    if (bound.error_m == 0.0f) {  // stays 0 whatever the eye does, until it is out of view
        result.bucket = kFlatBucket;
        result.guard_m = watches_fall ? seen_m : kFar;
        return result;
    }
    worst_px = std::max(worst_px, 1e-30f);
    const float shown_px = worst_px * (1.0f + kEdgeMargin);
    result.bucket = scale.bucket_of(shown_px);
    float guard =
        std::min({step * (1.0f - worst_px / scale.upper_px(result.bucket)), 0.06f * depth, hidden_m});
    if (watches_fall) {
        const float fall = 1.0f - (1.0f - kEdgeMargin) * scale.lower_px(result.bucket) / shown_px;
        guard = std::min({guard, seen_m, step * fall});
    }
    result.guard_m = std::max(guard, 0.0f);
    return result;
}

}  // namespace terrain
