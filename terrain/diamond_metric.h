// Screen error of a diamond, and how far the eye may move before its bucket can change.
//
// The lazy part of the queues. An evaluation says not only "2.3 px" but also "and it stays in its bucket until a
// point of the diamond has moved by g metres in the eye frame". Eye motion is summed up in two odometers (metres
// and radians); a diamond sleeps until they have gone far enough. So the cost of a frame follows the motion, not
// the size of the mesh.
//
// With depth m and error p, moving by g can raise the bound at most to p / (1 - g/m)^3 (perspective twice through
// the slant term, once through the depth), and 1 - y^(1/3) >= (1 - y) / 3 makes that a division.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "lod/screen_error.h"
#include "terrain/bucket_queue.h"

namespace terrain {

/// What a diamond's evaluation reads. 20 bytes.
struct DiamondBound {
    float x = 0, y = 0, z = 0;  ///< centre, metres from the terrain's anchor
    float radius_m = 0;         ///< contains both triangles and every sample they cover
    float error_m = 0;          ///< ErrorGrid's
};

/// One evaluation.
struct Evaluation {
    Bucket bucket = kHiddenBucket;
    float guard_m = 0.0f;     ///< displacement in the eye frame that keeps the statement true
    float distance_m = 0.0f;  ///< from the nearest eye to the centre
};

/// One eye, ready for loops: metric with the eye relative to the anchor.
struct AnchoredEye {
    lod::ViewMetric metric;
    glm::dvec3 eye{0.0};  ///< relative to the anchor
};

/// How far the error may fall before the statement ends, too: wanted for diamonds that could be merged.
enum class Watch : uint8_t { kRise, kRiseAndFall };

inline Evaluation evaluate(const DiamondBound& bound, std::span<const AnchoredEye> eyes,
                           const BucketScale& scale, Watch watch) {
    const double radius = double(bound.radius_m);
    constexpr double kFar = std::numeric_limits<double>::infinity();
    double worst_px = -1.0;  // negative: no eye sees it
    double hidden_m = kFar;  // how far it must move until one more eye sees it
    double seen_m = -1.0;    // how far until the last eye has lost it
    double nearest = kFar, least_depth = kFar;
    for (const AnchoredEye& eye : eyes) {
        const glm::dvec3 centre =
            eye.metric.eye_from_world * (glm::dvec3(bound.x, bound.y, bound.z) - eye.eye);
        const double outside = lod::distance_outside_m(eye.metric, centre, radius);
        const double distance = std::sqrt(glm::dot(centre, centre));
        nearest = std::min(nearest, distance);
        if (outside > 0.0) {
            hidden_m = std::min(hidden_m, outside);
            continue;
        }
        seen_m = std::max(seen_m, -outside);
        worst_px =
            std::max(worst_px, lod::screen_error_px(eye.metric, centre, radius, double(bound.error_m)));
        least_depth = std::min(
            least_depth,
            std::max({-centre.z - radius, (distance - radius) / eye.metric.stretch, eye.metric.near_m}));
    }
    Evaluation result;
    result.distance_m = static_cast<float>(nearest);
    if (worst_px < 0.0) {
        result.guard_m = static_cast<float>(hidden_m);
        return result;
    }
    if (bound.error_m == 0.0f) {  // stays 0 whatever the eye does, until it is out of view
        result.bucket = kFlatBucket;
        result.guard_m = watch == Watch::kRiseAndFall ? static_cast<float>(seen_m) : 1e30f;
        return result;
    }
    worst_px = std::max(worst_px * (1.0 + 1e-6), 1e-30);  // so that the float below is not under the bound
    result.bucket = scale.bucket_of(static_cast<float>(worst_px));
    const double upper = double(scale.upper_px(result.bucket)), lower = double(scale.lower_px(result.bucket));
    double guard = std::min(least_depth * (1.0 - worst_px / upper) / 3.0, hidden_m);
    if (watch == Watch::kRiseAndFall) {
        guard = std::min({guard, seen_m, lower > 0.0 ? least_depth * (1.0 - lower / worst_px) / 3.0 : guard});
    }
    result.guard_m = static_cast<float>(std::clamp(guard, 0.0, 1e30));
    return result;
}

}  // namespace terrain
