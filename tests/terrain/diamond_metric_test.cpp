// The four-lane metric beside lod::screen_error_px in double precision, and the guards beside random motion.
#include "terrain/diamond_metric.h"

#include <gtest/gtest.h>

#include "lod/base/rng.h"
#include "tests/terrain/test_relief.h"

namespace {

using terrain::FourBounds;

terrain::DiamondBound random_bound(lod::Rng& rng) {
    terrain::DiamondBound bound;
    const double away = std::exp(rng.between(0.0, 10.0));
    bound.centre = glm::vec3(rng.between(-away, away), rng.between(-away, away), rng.between(-200, 200));
    bound.radius_m = static_cast<float>(std::exp(rng.between(-1.0, 6.0)));
    bound.error_m = rng.unit() < 0.1 ? 0.0f : static_cast<float>(std::exp(rng.between(-6.0, 3.0)));
    return bound;
}

lod::View random_view(lod::Rng& rng) {
    return terrain_test::level_view({rng.between(-500, 500), rng.between(-500, 500), rng.between(1, 900)},
                                    rng.between(0, 6.3), rng.between(-1.5, 0.6));
}

/// What BoundMaker adds to a radius for the roundings of the metric.
terrain::DiamondBound padded(terrain::DiamondBound bound) {
    const float size = std::abs(bound.centre.x) + std::abs(bound.centre.y) + std::abs(bound.centre.z);
    bound.radius_m = (bound.radius_m + size * 0x1p-22f) * (1.0f + 0x1p-20f);
    return bound;
}

/// The largest error over the eyes, in double precision; 0 where none sees the sphere.
double error_px(const terrain::DiamondBound& bound, std::span<const terrain::AnchoredEye> eyes) {
    double worst = 0.0;
    for (const terrain::AnchoredEye& eye : eyes) {
        const glm::dvec3 centre = eye.metric.eye_from_world * (glm::dvec3(bound.centre) - eye.eye);
        if (lod::distance_outside_m(eye.metric, centre, double(bound.radius_m)) > 0.0) continue;
        worst = std::max(
            worst, lod::screen_error_px(eye.metric, centre, double(bound.radius_m), double(bound.error_m)));
    }
    return worst;
}

TEST(DiamondMetric, IsTheDoubleMetricRoundedUp) {
    lod::Rng rng(3);
    const terrain::BucketScale scale{0.7f};
    for (int round = 0; round < 20'000; ++round) {
        const std::vector<terrain::AnchoredEye> eyes(1 + rng.below(2),
                                                     terrain::AnchoredEye(random_view(rng), glm::dvec3(0.0)));
        FourBounds four;
        std::array<terrain::DiamondBound, 4> bounds;
        for (int lane = 0; lane < 4; ++lane) {
            bounds[static_cast<size_t>(lane)] = random_bound(rng);
            four.set(lane, padded(bounds[static_cast<size_t>(lane)]));
        }
        const terrain::FourEvaluations now = terrain::evaluate(four, eyes, scale, lod::Int4{});
        for (size_t lane = 0; lane < 4; ++lane) {
            const double exact = error_px(bounds[lane], eyes);
            const auto bucket = static_cast<terrain::Bucket>(now.bucket[lane]);
            ASSERT_LE(exact, double(scale.upper_px(bucket))) << "round " << round;
            if (exact == 0.0) continue;
            ASSERT_NE(bucket, terrain::kHiddenBucket);
            ASSERT_GE(double(now.error_px[lane]), exact * (1.0 - 1e-5));
            const double room = error_px(padded(padded(bounds[lane])), eyes);
            ASSERT_LE(double(now.error_px[lane]), std::max(exact, room) * (1.0 + 1e-3));
        }
    }
}

/// While the eye has moved and turned by less than the guard allows, the bucket's promise holds.
TEST(DiamondMetric, GuardsHoldUnderMotion) {
    lod::Rng rng(4);
    const terrain::BucketScale scale{1.0f};
    for (int round = 0; round < 20'000; ++round) {
        lod::View view = random_view(rng);
        std::vector<terrain::AnchoredEye> eye(1, terrain::AnchoredEye(view, glm::dvec3(0.0)));
        const terrain::DiamondBound bound = random_bound(rng);
        FourBounds four;
        four.set(0, padded(bound));
        const terrain::FourEvaluations now = terrain::evaluate(four, eye, scale, lod::Int4{});
        const double guard_m = std::min(double(now.guard_m[0]), 1e5) * rng.unit();
        const glm::dvec3 way = glm::normalize(
            glm::dvec3(rng.between(-1, 1), rng.between(-1, 1), rng.between(-1, 1)) + glm::dvec3(1e-9));
        view.eye_world += way * guard_m;
        eye.assign(1, terrain::AnchoredEye(view, glm::dvec3(0.0)));
        ASSERT_LE(error_px(bound, eye),
                  double(scale.upper_px(static_cast<terrain::Bucket>(now.bucket[0]))) * (1.0 + 1e-5))
            << "round " << round << ", moved " << guard_m << " m";
    }
}

TEST(DiamondMetric, BucketEdgesAreWhatTheySay) {
    const terrain::BucketScale scale{1.3f};
    for (int bucket = terrain::kFirstErrorBucket; bucket < 255; ++bucket) {
        const lod::Int4 four = lod::Int4{} + bucket;
        EXPECT_EQ(scale.lowers_px(four)[2], scale.lower_px(static_cast<terrain::Bucket>(bucket)));
        EXPECT_EQ(scale.uppers_px(four)[1], scale.upper_px(static_cast<terrain::Bucket>(bucket)));
        const float below = std::nextafter(scale.upper_px(static_cast<terrain::Bucket>(bucket)), 0.0f);
        EXPECT_LE(scale.bucket_of(below), bucket + 1);
        EXPECT_GE(scale.bucket_of(scale.upper_px(static_cast<terrain::Bucket>(bucket))), bucket);
    }
}

}  // namespace
