// How far a triangle is seen to move, against points sampled all over it and projected before and after.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "lod/base/rng.h"
#include "terrain/corner_shift.h"
#include "tests/terrain/test_relief.h"

namespace {

/// Pixels between two places of one point, seen by an eye at the anchor; -1 where neither is in the picture.
double shift_px(const lod::ViewMetric& metric, const glm::dvec3& before, const glm::dvec3& after) {
    const glm::dvec3 then = metric.eye_from_world * before, now = metric.eye_from_world * after;
    if (-then.z < metric.near_m || -now.z < metric.near_m) return -1.0;
    const auto is_seen = [&](const glm::dvec3& p) {
        return std::abs(p.x) <= -p.z * metric.tan_x && std::abs(p.y) <= -p.z * metric.tan_y;
    };
    if (!is_seen(then) && !is_seen(now)) return -1.0;
    return metric.lambda_px * glm::length(glm::dvec2(now) / -now.z - glm::dvec2(then) / -then.z);
}

TEST(CornerShift, HoldsForEveryPointAndIsTight) {
    lod::Rng rng(7);
    const lod::View view = terrain_test::level_view({0.0, 0.0, 0.0}, 0.4, -0.3);
    const lod::AnchoredEye eye(view, glm::dvec3(0.0));
    const auto between = [&](double low, double high) { return rng.between(low, high); };
    double tightest = std::numeric_limits<double>::infinity();
    int seen_count = 0;
    for (int round = 0; round < 2000; ++round) {
        // Ground around and beneath the eye, much of it out of the picture.
        std::array<glm::vec3, 3> corners;
        const double spread = round % 2 == 0 ? 300.0 : 40.0;
        const glm::vec3 middle(between(-200.0, 200.0), between(0.0, 400.0), between(-60.0, -5.0));
        for (glm::vec3& corner : corners)
            corner =
                middle + glm::vec3(between(-spread, spread), between(-spread, spread), between(-5.0, 5.0));
        const glm::vec3 way(0.0f, 0.0f, static_cast<float>(between(-0.5, 0.5)));
        double worst_px = 0.0;
        constexpr int kSteps = 60;
        for (int i = 0; i <= kSteps; ++i) {
            for (int j = 0; i + j <= kSteps; ++j) {
                const double a = double(i) / kSteps, b = double(j) / kSteps, c = 1.0 - a - b;
                const glm::dvec3 after =
                    a * glm::dvec3(corners[0]) + b * glm::dvec3(corners[1]) + c * glm::dvec3(corners[2]);
                worst_px = std::max(worst_px, shift_px(eye.metric, after - a * glm::dvec3(way), after));
            }
        }
        const double told_px = terrain::corner_shift_px({&eye, 1}, corners, way);
        ASSERT_GE(told_px, worst_px - 1e-9) << "round " << round;
        if (worst_px < 0.05) continue;
        ++seen_count;
        tightest = std::min(tightest, told_px / worst_px);
    }
    EXPECT_GT(seen_count, 300);
    EXPECT_LT(tightest, 1.2) << "nowhere near what happens";
}

TEST(CornerShift, WhatIsBehindTheEyeIsNotSeen) {
    const lod::View view = terrain_test::level_view({0.0, 0.0, 0.0}, 0.0, 0.0);  // north
    const lod::AnchoredEye eye(view, glm::dvec3(0.0));
    const std::array<glm::vec3, 3> behind = {glm::vec3{0, -50, -10}, {30, -90, -10}, {-30, -90, -10}};
    EXPECT_EQ(terrain::corner_shift_px({&eye, 1}, behind, {0.0f, 0.0f, 2.0f}), 0.0);
    EXPECT_EQ(terrain::corner_shift_px({&eye, 1}, behind, {0.0f, 0.0f, 0.0f}), 0.0);
}

}  // namespace
