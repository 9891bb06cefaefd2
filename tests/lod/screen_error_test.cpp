// The screen error of a box beside what moving its points does to their images.
#include "lod/screen_error.h"

#include <gtest/gtest.h>

#include "lod/base/rng.h"

namespace {

lod::ViewMetric random_metric(lod::Rng& rng) {
    lod::View view;
    view.width_px = 640;
    view.height_px = 360;
    view.fov_y_rad = rng.between(0.2, 1.9);
    view.near_m = rng.between(0.1, 2.0);
    return lod::metric_of(view);
}

glm::dvec3 random_direction(lod::Rng& rng) {
    for (;;) {
        const glm::dvec3 way(rng.between(-1, 1), rng.between(-1, 1), rng.between(-1, 1));
        const double length = glm::length(way);
        if (length > 0.1 && length < 1.0) return way / length;
    }
}

/// A box whose middle is in view: flat, long or small, near or far, turned at random.
lod::EyeBox random_box(lod::Rng& rng, const lod::ViewMetric& metric) {
    const double depth_m = std::exp(rng.between(0.0, 8.0));
    const glm::dvec3 middle(depth_m * metric.tan_x * rng.between(-1, 1),
                            depth_m * metric.tan_y * rng.between(-1, 1), -depth_m);
    const glm::dvec3 x = random_direction(rng), y = glm::normalize(glm::cross(x, random_direction(rng))),
                     z = glm::cross(x, y);
    const double size_m = depth_m * std::exp(rng.between(-6.0, 0.5));
    const glm::dvec3 half = size_m * glm::dvec3(rng.unit(), rng.unit(), rng.unit() < 0.3 ? 0.0 : rng.unit());
    lod::EyeBox box;
    for (size_t i = 0; i < box.size(); ++i) {
        const auto side = [&](size_t axis) { return (i >> axis & 1) != 0 ? 1.0 : -1.0; };
        box[i] = middle + side(0) * half.x * x + side(1) * half.y * y + side(2) * half.z * z;
    }
    return box;
}

glm::dvec3 point_in(const lod::EyeBox& box, const glm::dvec3& share) {
    return box[0] + share.x * (box[1] - box[0]) + share.y * (box[2] - box[0]) + share.z * (box[4] - box[0]);
}

bool is_in_view(const lod::ViewMetric& metric, const glm::dvec3& p) {
    return -p.z >= metric.near_m && std::abs(p.x) <= -p.z * metric.tan_x &&
           std::abs(p.y) <= -p.z * metric.tan_y;
}

glm::dvec2 image_px(const lod::ViewMetric& metric, const glm::dvec3& p) {
    return metric.lambda_px * glm::dvec2(p.x, p.y) / -p.z;
}

/// In the direction that moves the image most: away from the line of sight, and towards or from the eye.
double most_moved_px(const lod::ViewMetric& metric, const glm::dvec3& p, double error_m) {
    const double off_m = std::hypot(p.x, p.y);
    const glm::dvec2 out = off_m > 0.0 ? glm::dvec2(p.x, p.y) / off_m : glm::dvec2(1.0, 0.0);
    const glm::dvec3 way = glm::normalize(glm::dvec3(out * -p.z, off_m));
    return glm::distance(image_px(metric, p + error_m * way), image_px(metric, p));
}

TEST(BoxScreenError, NoPointOfTheBoxMovesFarther) {
    lod::Rng rng(11);
    for (int round = 0; round < 20'000; ++round) {
        const lod::ViewMetric metric = random_metric(rng);
        const lod::EyeBox box = random_box(rng, metric);
        for (int sample = 0; sample < 40; ++sample) {
            const glm::dvec3 p = point_in(box, {rng.unit(), rng.unit(), rng.unit()});
            if (!is_in_view(metric, p)) continue;
            const double error_m = 1e-5 * -p.z;
            const double limit_px = lod::screen_error_px(metric, box, error_m) * (1.0 + 1e-3);
            ASSERT_LE(most_moved_px(metric, p, error_m), limit_px) << round;
            const glm::dvec3 moved = p + error_m * random_direction(rng);
            ASSERT_LE(glm::distance(image_px(metric, moved), image_px(metric, p)), limit_px) << round;
        }
    }
}

/// Far from the line of sight the worst point of an edge may lie between its ends: here both cost the same.
TEST(BoxScreenError, HoldsBetweenCornersAtWideAngles) {
    const lod::ViewMetric metric =
        lod::metric_of({.fov_y_rad = 2.4, .width_px = 640, .height_px = 360, .near_m = 0.1});
    for (double near_slant = 1.05; near_slant < 3.0; near_slant += 0.1) {
        for (double far_slant = near_slant + 0.1; far_slant < 4.0; far_slant += 0.1) {
            const auto at = [](double slant) {
                return glm::dvec3(slant * std::sqrt(slant * slant - 1.0), 0.0, -slant);
            };
            lod::EyeBox box;
            for (size_t i = 0; i < box.size(); ++i)
                box[i] = (i & 1) != 0 ? at(far_slant) : at(near_slant);
            for (double share = 0.0; share <= 1.0; share += 0.05) {
                const glm::dvec3 p = point_in(box, {share, 0.0, 0.0});
                if (!is_in_view(metric, p)) continue;
                ASSERT_LE(most_moved_px(metric, p, 1e-6),
                          lod::screen_error_px(metric, box, 1e-6) * (1.0 + 1e-4))
                    << near_slant << " to " << far_slant;
            }
        }
    }
}

/// A bound that is never reached would cost triangles.
TEST(BoxScreenError, SomePointOfTheBoxMovesAsFar) {
    lod::Rng rng(12);
    int looked_at = 0;
    for (int round = 0; round < 20'000; ++round) {
        const lod::ViewMetric metric = random_metric(rng);
        const lod::EyeBox box = random_box(rng, metric);
        const bool is_whole = std::all_of(box.begin(), box.end(), [&](const glm::dvec3& corner) {
            return is_in_view(metric, corner) && glm::length(corner) < 1.2 * -corner.z;
        });
        if (!is_whole) continue;
        ++looked_at;
        const double error_m = 1e-6 * glm::length(box[0]);
        double most_px = 0.0;
        for (int i = 0; i < 8; ++i)
            most_px = std::max(
                most_px,
                most_moved_px(metric, point_in(box, glm::dvec3(i & 1, i >> 1 & 1, i >> 2)), error_m));
        ASSERT_NEAR(lod::screen_error_px(metric, box, error_m), most_px, 1e-3 * most_px) << round;
    }
    EXPECT_GT(looked_at, 3000);
}

TEST(BoxScreenError, IsFiniteAroundTheEye) {
    const lod::ViewMetric metric = lod::metric_of({.near_m = 0.5});
    lod::EyeBox box;
    for (size_t i = 0; i < box.size(); ++i)
        box[i] = {(i & 1) != 0 ? 3.0 : -3.0, (i & 2) != 0 ? 3.0 : -3.0, (i & 4) != 0 ? 3.0 : -3.0};
    EXPECT_NEAR(lod::screen_error_px(metric, box, 1.0), metric.lambda_px * metric.stretch / 0.5, 1e-9);
    EXPECT_EQ(lod::distance_to_eye_m(box), 0.0);
    box.fill({0.0, 0.0, 0.0});
    EXPECT_TRUE(std::isfinite(lod::screen_error_px(metric, box, 1.0)));
    EXPECT_EQ(lod::screen_error_px(metric, box, 0.0), 0.0);
}

TEST(BoxScreenError, NothingInViewIsOutside) {
    lod::Rng rng(13);
    int outside = 0;
    for (int round = 0; round < 20'000; ++round) {
        const lod::ViewMetric metric = random_metric(rng);
        lod::EyeBox box = random_box(rng, metric);
        const glm::dvec3 aside = 2.0 * glm::length(box[0]) * random_direction(rng);
        for (glm::dvec3& corner : box)
            corner += aside;
        if (!lod::is_outside(metric, box)) continue;
        ++outside;
        for (int sample = 0; sample < 20; ++sample)
            ASSERT_FALSE(is_in_view(metric, point_in(box, {rng.unit(), rng.unit(), rng.unit()}))) << round;
    }
    EXPECT_GT(outside, 5000);
}

TEST(BoxScreenError, DistanceIsOfTheNearestPoint) {
    lod::Rng rng(14);
    for (int round = 0; round < 2000; ++round) {
        const lod::EyeBox box = random_box(rng, random_metric(rng));
        double nearest_m = 1e300;
        for (int sample = 0; sample < 300; ++sample)
            nearest_m = std::min(nearest_m, glm::length(point_in(box, {rng.unit(), rng.unit(), rng.unit()})));
        const double diagonal_m = glm::distance(box[0], box[7]);
        ASSERT_LE(lod::distance_to_eye_m(box), nearest_m * (1.0 + 1e-12));
        ASSERT_GE(lod::distance_to_eye_m(box), nearest_m - 0.5 * diagonal_m);
    }
}

}  // namespace
