// The four-lane metric beside lod::screen_error_px in double precision, and the guards beside random motion.
#include "lod/sight_metric.h"

#include <gtest/gtest.h>

#include "lod/base/rng.h"

namespace {

using lod::FourBounds;

lod::ErrorSphere random_bound(lod::Rng& rng) {
    lod::ErrorSphere bound;
    const double away = std::exp(rng.between(0.0, 10.0));
    bound.centre = glm::vec3(rng.between(-away, away), rng.between(-away, away), rng.between(-200, 200));
    bound.radius_m = static_cast<float>(std::exp(rng.between(-1.0, 6.0)));
    bound.error_m = rng.unit() < 0.1 ? 0.0f : static_cast<float>(std::exp(rng.between(-6.0, 3.0)));
    return bound;
}

lod::View random_view(lod::Rng& rng) {
    lod::View view;
    view.eye_world = {rng.between(-500, 500), rng.between(-500, 500), rng.between(1, 900)};
    const double heading_rad = rng.between(0, 6.3), pitch_rad = rng.between(-1.5, 0.6);
    view.eye_from_world = lod::eye_from_attitude(glm::dmat3(1.0), heading_rad, pitch_rad, 0.0);
    view.width_px = 1280;
    view.height_px = 720;
    return view;
}

/// What makers of spheres add to a radius for the roundings of the metric.
lod::ErrorSphere padded(lod::ErrorSphere bound) {
    const float size = std::abs(bound.centre.x) + std::abs(bound.centre.y) + std::abs(bound.centre.z);
    bound.radius_m = (bound.radius_m + size * 0x1p-22f) * (1.0f + 0x1p-20f);
    return bound;
}

/// The largest error over the eyes, in double precision; 0 where none sees the sphere.
double error_px(const lod::ErrorSphere& bound, std::span<const lod::AnchoredEye> eyes) {
    double worst = 0.0;
    for (const lod::AnchoredEye& eye : eyes) {
        const glm::dvec3 centre = eye.metric.eye_from_world * (glm::dvec3(bound.centre) - eye.eye);
        if (lod::distance_outside_m(eye.metric, centre, double(bound.radius_m)) > 0.0) continue;
        worst = std::max(
            worst, lod::screen_error_px(eye.metric, centre, double(bound.radius_m), double(bound.error_m)));
    }
    return worst;
}

TEST(SightMetric, IsTheDoubleMetricRoundedUp) {
    lod::Rng rng(3);
    const lod::BucketScale scale{0.7f};
    for (int round = 0; round < 20'000; ++round) {
        const std::vector<lod::AnchoredEye> eyes(1 + rng.below(2),
                                                 lod::AnchoredEye(random_view(rng), glm::dvec3(0.0)));
        FourBounds four;
        std::array<lod::ErrorSphere, 4> bounds;
        for (int lane = 0; lane < 4; ++lane) {
            bounds[static_cast<size_t>(lane)] = random_bound(rng);
            four.set(lane, padded(bounds[static_cast<size_t>(lane)]));
        }
        const lod::FourEvaluations now = lod::evaluate(four, eyes, scale, lod::Int4{});
        for (size_t lane = 0; lane < 4; ++lane) {
            const double exact = error_px(bounds[lane], eyes);
            const auto bucket = static_cast<lod::Bucket>(now.bucket[lane]);
            ASSERT_LE(exact, double(scale.upper_px(bucket))) << "round " << round;
            if (exact == 0.0) continue;
            ASSERT_NE(bucket, lod::kHiddenBucket);
            ASSERT_GE(double(now.error_px[lane]), exact * (1.0 - 1e-5));
            const double room = error_px(padded(padded(bounds[lane])), eyes);
            ASSERT_LE(double(now.error_px[lane]), std::max(exact, room) * (1.0 + 1e-3));
        }
    }
}

/// While the eye has moved and turned by less than the guard allows, the bucket's promise holds.
TEST(SightMetric, GuardsHoldUnderMotion) {
    lod::Rng rng(4);
    const lod::BucketScale scale{1.0f};
    for (int round = 0; round < 20'000; ++round) {
        lod::View view = random_view(rng);
        std::vector<lod::AnchoredEye> eye(1, lod::AnchoredEye(view, glm::dvec3(0.0)));
        const lod::ErrorSphere bound = random_bound(rng);
        FourBounds four;
        four.set(0, padded(bound));
        const lod::FourEvaluations now = lod::evaluate(four, eye, scale, lod::Int4{});
        const double guard_m = std::min(double(now.guard_m[0]), 1e5) * rng.unit();
        const glm::dvec3 way = glm::normalize(
            glm::dvec3(rng.between(-1, 1), rng.between(-1, 1), rng.between(-1, 1)) + glm::dvec3(1e-9));
        view.eye_world += way * guard_m;
        eye.assign(1, lod::AnchoredEye(view, glm::dvec3(0.0)));
        ASSERT_LE(error_px(bound, eye),
                  double(scale.upper_px(static_cast<lod::Bucket>(now.bucket[0]))) * (1.0 + 1e-5))
            << "round " << round << ", moved " << guard_m << " m";
    }
}

TEST(SightMetric, BucketEdgesAreWhatTheySay) {
    const lod::BucketScale scale{1.3f};
    for (int bucket = lod::kFirstErrorBucket; bucket < 255; ++bucket) {
        const lod::Int4 four = lod::Int4{} + bucket;
        EXPECT_EQ(scale.lowers_px(four)[2], scale.lower_px(static_cast<lod::Bucket>(bucket)));
        EXPECT_EQ(scale.uppers_px(four)[1], scale.upper_px(static_cast<lod::Bucket>(bucket)));
        const float below = std::nextafter(scale.upper_px(static_cast<lod::Bucket>(bucket)), 0.0f);
        EXPECT_LE(scale.bucket_of(below), bucket + 1);
        EXPECT_GE(scale.bucket_of(scale.upper_px(static_cast<lod::Bucket>(bucket))), bucket);
    }
}

/// An edge above the tolerance would have the bucket below it refined, up to an eighth finer than asked for.
TEST(SightMetric, TheToleranceIsAnEdge) {
    lod::Rng rng(5);
    for (int round = 0; round < 10'000; ++round) {
        const double tolerance_px = std::exp(rng.between(-12.0, 8.0));
        const lod::BucketScale scale = lod::scale_at(tolerance_px);
        const lod::Bucket above = scale.bucket_of(std::nextafter(static_cast<float>(tolerance_px), 1e30f));
        const lod::Bucket below = scale.bucket_of(static_cast<float>(tolerance_px * (1.0 - 1e-6)));
        ASSERT_EQ(above, below + 1) << tolerance_px;
        ASSERT_LE(double(scale.upper_px(below)), tolerance_px);
        ASSERT_GT(double(scale.upper_px(below)), tolerance_px * (1.0 - 1e-6));
        ASSERT_GT(double(scale.upper_px(above)), tolerance_px);
    }
    EXPECT_EQ(lod::scale_at(0.0).reference_px, 1.0f);
}

}  // namespace
