// Screen error of a sphere, and how far the eye may move before its bucket can change.
//
// The lazy part of the queues. An evaluation says not only "2.3 px" but also "and it stays in its bucket until a
// point of the sphere has moved by g metres in the eye frame". Eye motion is summed up in two odometers (metres
// and radians); what is ranked sleeps until they have gone far enough. So the cost of a frame follows the motion, not
// the size of the mesh.
//
// The bound is p = lambda e (d + r) / f^2 with f the depth of the sphere's near side. Its logarithm changes by at
// most sqrt(4 - 3 q^2) / f per metre, q = f / (d + r): between 1/f straight ahead and 2/f at the side. While the
// eye moves by less than 0.06 f, q shrinks by less than 12 %, hence the 2.3 below.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "lod/base/float4.h"
#include "lod/bucket_queue.h"
#include "lod/screen_error.h"

namespace lod {

/// What may be wrong by `error_m` lies within the sphere.
struct ErrorSphere {
    glm::vec3 centre{0.0f};  ///< relative to the anchor
    float radius_m = 0.0f;
    float error_m = 0.0f;
};

/// Spheres and their errors, four side by side.
struct FourBounds {
    Float4 x{}, y{}, z{}, radius_m{}, error_m{};

    void set(int lane, const ErrorSphere& bound) {
        x[lane] = bound.centre.x;
        y[lane] = bound.centre.y;
        z[lane] = bound.centre.z;
        radius_m[lane] = bound.radius_m;
        error_m[lane] = bound.error_m;
    }
};

/// Their evaluations.
struct FourEvaluations {
    Int4 bucket{};        ///< kHiddenBucket, kFlatBucket or where the error falls
    Float4 error_px{};    ///< upper bound; 0 when no eye sees it
    Float4 guard_m{};     ///< displacement in the eye frame that keeps the statement true
    Float4 distance_m{};  ///< from the nearest eye to the centre
};

/// An eye's numbers in all four lanes.
struct EyeLanes {
    Float4 eye[3], rotation[9];  ///< rotation: column by column
    Float4 tan_x, tan_y, cos_x, cos_y, inverse_stretch, stretch, near_m, lambda_px;
};

/// One eye, ready for loops: the view's metric in single precision, the eye relative to the anchor.
struct AnchoredEye {
    explicit AnchoredEye(const View& view, const glm::dvec3& anchor)
        : metric(metric_of(view)),
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
          lambda_px(static_cast<float>(metric.lambda_px * (1.0 + 0x1p-18))) {
        for (int i = 0; i < 3; ++i)
            lanes.eye[i] = splat(eye_f[i]);
        for (int i = 0; i < 9; ++i)
            lanes.rotation[i] = splat(rotation[i / 3][i % 3]);
        lanes.tan_x = splat(tan_x), lanes.tan_y = splat(tan_y);
        lanes.cos_x = splat(cos_x), lanes.cos_y = splat(cos_y);
        lanes.inverse_stretch = splat(inverse_stretch), lanes.stretch = splat(stretch);
        lanes.near_m = splat(near_m), lanes.lambda_px = splat(lambda_px);
    }

    ViewMetric metric;
    glm::dvec3 eye;
    glm::vec3 eye_f;
    glm::mat3 rotation;
    float tan_x, tan_y, cos_x, cos_y, inverse_stretch, stretch, near_m, lambda_px;
    EyeLanes lanes;

    glm::vec3 to_eye(const glm::vec3& anchored) const { return rotation * (anchored - eye_f); }

    /// distance_outside_m in single precision; `centre` in the eye frame.
    float distance_outside_m(const glm::vec3& centre, float radius) const {
        const float x = (std::abs(centre.x) + centre.z * tan_x) * cos_x;
        const float y = (std::abs(centre.y) + centre.z * tan_y) * cos_y;
        return std::max(std::max(x, y), near_m + centre.z) - radius;
    }
};

/// What is about to cross an edge counts as beyond it, and what is about to come into view as seen: otherwise what
/// creeps up to an edge would wake in ever shorter steps.
inline constexpr float kEdgeMargin = 0.015f;   ///< of the error
inline constexpr float kSightMargin = 0.003f;  ///< of the distance

/// Screen errors and the depths at which they were taken: screen_error_px in single precision.
struct FourDepthErrors {
    Float4 error_px;
    Float4 depth_m;
    Float4 step_m;  ///< moving by x * step_m, x <= 0.06, changes error_px by a factor of at most 1 + x
};
inline FourDepthErrors depth_errors(const EyeLanes& eye, const FourBounds& bound, Float4 centre_z,
                                    Float4 distance) {
    const Float4 near_m = eye.near_m, one = splat(1.0f);
    const Float4 front = -centre_z - bound.radius_m, far_m = distance + bound.radius_m;
    const Float4 depth = max(max(front, (distance - bound.radius_m) * eye.inverse_stretch), near_m);
    const Float4 slant = min(eye.stretch, far_m / max(front, near_m));
    // 1 / sqrt(4 - 2.3 q^2) >= 1/2 + q^2 / 7: a tangent, and safe.
    const Float4 q = min(depth / far_m, one);
    return {eye.lambda_px * bound.error_m * max(slant, one) / depth, depth,
            depth * (0.5f + q * q * (1.0f / 7.0f))};
}

/// What all eyes together see of four spheres.
struct FourSights {
    static constexpr float kFar = 1e30f;
    Float4 worst_px = splat(-1.0f);  ///< negative: no eye sees it
    Float4 shown_px{};               ///< the same without the margin of sight
    Float4 hidden_m = splat(kFar);   ///< how far it must move until one more eye sees it
    Float4 seen_m = splat(-1.0f);    ///< how far until the last eye has lost it
    Float4 nearest_m = splat(kFar), depth_m = splat(kFar), step_m = splat(kFar);

    void look(const EyeLanes& eye, const FourBounds& bound) {
        const Float4 ax = bound.x - eye.eye[0], ay = bound.y - eye.eye[1], az = bound.z - eye.eye[2];
        const Float4* r = eye.rotation;
        const Float4 x = r[0] * ax + r[3] * ay + r[6] * az;
        const Float4 y = r[1] * ax + r[4] * ay + r[7] * az;
        const Float4 z = r[2] * ax + r[5] * ay + r[8] * az;
        const Float4 outside =
            max(max((abs(x) + z * eye.tan_x) * eye.cos_x, (abs(y) + z * eye.tan_y) * eye.cos_y),
                eye.near_m + z) -
            bound.radius_m;
        const Float4 distance = sqrt(x * x + y * y + z * z);
        nearest_m = min(nearest_m, distance);
        const Float4 margin = kSightMargin * distance;
        const Int4 hidden = outside > margin;
        const FourDepthErrors here = depth_errors(eye, bound, z, distance);
        hidden_m = hidden ? min(hidden_m, outside) : hidden_m;
        seen_m = hidden ? seen_m : max(seen_m, margin - outside);
        worst_px = hidden ? worst_px : max(worst_px, here.error_px);
        shown_px = outside <= 0.0f ? max(shown_px, here.error_px) : shown_px;
        depth_m = hidden ? depth_m : min(depth_m, here.depth_m);
        step_m = hidden ? step_m : min(step_m, here.step_m);
    }
};

/// @param watches_fall  mask: the statement also ends when the error falls out of its bucket, or out of view;
///                      wanted for what could be coarsened
/// Cost: about 30 ns for four (terrain_bench).
inline FourEvaluations evaluate(const FourBounds& bound, std::span<const AnchoredEye> eyes,
                                const BucketScale& scale, Int4 watches_fall) {
    FourSights sight;
    for (const AnchoredEye& eye : eyes)
        sight.look(eye.lanes, bound);
    const Float4 worst_px = max(sight.worst_px, splat(1e-30f));
    const Float4 beyond_px = worst_px * (1.0f + kEdgeMargin);
    const Int4 bucket = scale.buckets_of(beyond_px);
    Float4 guard = sight.step_m * (1.0f - worst_px / scale.uppers_px(bucket));
    guard = min(min(guard, 0.06f * sight.depth_m), sight.hidden_m);
    if (any(watches_fall)) {
        const Float4 fall = 1.0f - (1.0f - kEdgeMargin) * scale.lowers_px(bucket) / beyond_px;
        guard = watches_fall ? min(min(guard, sight.seen_m), sight.step_m * fall) : guard;
    }
    // An error of 0 stays 0 whatever the eye does, until it is out of view.
    const Int4 is_flat = bound.error_m == 0.0f, is_hidden = sight.worst_px < 0.0f;
    const Float4 flat_guard = watches_fall ? sight.seen_m : splat(FourSights::kFar);
    FourEvaluations result;
    result.bucket = is_hidden ? Int4{} + int32_t(kHiddenBucket)
                    : is_flat ? Int4{} + int32_t(kFlatBucket)
                              : bucket;
    result.guard_m = is_hidden ? sight.hidden_m : is_flat ? flat_guard : max(guard, Float4{});
    result.error_px = is_hidden ? Float4{} : sight.shown_px;
    result.distance_m = sight.nearest_m;
    return result;
}

}  // namespace lod
