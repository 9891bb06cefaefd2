#include "lod/occlusion_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "lod/base/rng.h"
#include "tests/lod/eye_views.h"

namespace {

using lod_test::view_of;

/// A box anyhow turned, in the eye frame.
struct Box {
    glm::dvec3 centre{0.0};
    glm::dmat3 axes{1.0};  ///< columns, unit
    glm::dvec3 half{1.0};

    std::array<glm::dvec3, 8> corners() const {
        std::array<glm::dvec3, 8> out;
        for (size_t i = 0; i < 8; ++i) {
            const glm::dvec3 sign((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0,
                                  (i & 4) != 0 ? 1.0 : -1.0);
            out[i] = centre + axes * (sign * half);
        }
        return out;
    }
    /// Depth at which the ray through the eye and (x, y, -1) comes out at the far side; 0: it misses. By slabs.
    double exit_depth_m(const glm::dvec2& slope) const {
        const glm::dvec3 along = glm::transpose(axes) * glm::dvec3(slope, -1.0);
        const glm::dvec3 from = glm::transpose(axes) * -centre;
        double enter = 0.0, leave = 1e30;
        for (glm::length_t k = 0; k < 3; ++k) {
            const double a = (-half[k] - from[k]) / along[k], b = (half[k] - from[k]) / along[k];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        return enter < leave ? leave : 0.0;
    }
};

glm::dmat3 random_turn(lod::Rng& rng) {
    const auto random = [&rng] { return glm::dvec3(rng.unit() - 0.5, rng.unit() - 0.5, rng.unit() - 0.5); };
    const glm::dvec3 a = glm::normalize(random());
    const glm::dvec3 b = glm::normalize(glm::cross(a, random()));
    return {a, b, glm::cross(a, b)};
}

Box random_box(lod::Rng& rng, double depth_m, double size_m) {
    const glm::dvec3 at(1.6 * (rng.unit() - 0.5) * depth_m, 1.0 * (rng.unit() - 0.5) * depth_m, -depth_m);
    const auto half = [&rng, size_m] { return size_m * (0.05 + 0.45 * rng.unit()); };
    return {at, random_turn(rng), {half(), half(), half()}};
}

/// Whoever is said to be hidden is: through the centre of every pixel that a point of it falls into, some solid stands
/// in front. Widths that are no multiple of a cell, too.
TEST(OcclusionMap, WhatIsHiddenHasASolidInFrontOfEveryPixel) {
    lod::Rng rng(11);
    size_t hidden = 0, asked = 0;
    for (int round = 0; round < 60; ++round) {
        const lod::View view = view_of(150 + 10 * (round % 7), 100 + 3 * (round % 5));
        const lod::ViewMetric metric = lod::metric_of(view);
        lod::OcclusionMap map;
        map.begin(metric, view.width_px, view.height_px);
        std::vector<Box> solids;
        for (int i = 0; i < 40; ++i) {
            solids.push_back(random_box(rng, 4.0 + 16.0 * rng.unit(), 8.0));
            map.add_convex(solids.back().corners());
        }
        // Of these nothing is known: they reach through the near plane.
        std::erase_if(solids, [&](const Box& box) {
            const auto corners = box.corners();
            return std::any_of(corners.begin(), corners.end(),
                               [&](const glm::dvec3& corner) { return -corner.z <= view.near_m; });
        });
        for (int i = 0; i < 100; ++i) {
            const Box box = random_box(rng, 10.0 + 60.0 * rng.unit(), 6.0);
            ++asked;
            if (!map.hides(box.corners())) continue;
            ++hidden;
            for (int k = 0; k < 300; ++k) {
                const glm::dvec3 within(2.0 * rng.unit() - 1.0, 2.0 * rng.unit() - 1.0,
                                        2.0 * rng.unit() - 1.0);
                const glm::dvec3 point = box.centre + box.axes * (within * box.half);
                const glm::dvec2 size(view.width_px, view.height_px);
                const glm::dvec2 pixel =
                    glm::floor(glm::dvec2(point) * (metric.lambda_px / -point.z) + 0.5 * size);
                if (pixel.x < 0.0 || pixel.y < 0.0 || pixel.x >= size.x || pixel.y >= size.y) continue;
                const glm::dvec2 slope = (pixel + 0.5 - 0.5 * size) / metric.lambda_px;
                const bool is_covered = std::any_of(solids.begin(), solids.end(), [&](const Box& solid) {
                    const double depth_m = solid.exit_depth_m(slope);
                    return depth_m > 0.0 && depth_m < -point.z;
                });
                ASSERT_TRUE(is_covered) << "round " << round << ", pixel " << pixel.x << ' ' << pixel.y;
            }
        }
    }
    EXPECT_GT(hidden, asked / 10);
    EXPECT_LT(hidden, asked);
}

/// Two solids side by side hide together what neither hides alone.
TEST(OcclusionMap, NeighboursHideTogether) {
    const lod::View view = view_of(640, 360);
    const Box left{{-5.0, 0.0, -20.0}, glm::dmat3(1.0), {5.003, 4.0, 1.0}};
    const Box right{{5.0, 0.0, -24.0}, glm::dmat3(1.0), {5.003, 4.0, 1.0}};
    const Box behind{{0.0, 0.0, -60.0}, glm::dmat3(1.0), {3.0, 3.0, 3.0}};
    lod::OcclusionMap map;
    map.begin(lod::metric_of(view), view.width_px, view.height_px);
    map.add_convex(left.corners());
    EXPECT_FALSE(map.hides(behind.corners()));
    map.add_convex(right.corners());
    EXPECT_TRUE(map.hides(behind.corners()));
    EXPECT_FALSE(map.hides(left.corners())) << "nothing hides itself";
    const Box between{{0.0, 0.0, -22.5}, glm::dmat3(1.0), {0.5, 0.5, 0.5}};
    EXPECT_FALSE(map.hides(between.corners())) << "the right one is no nearer";
    map.begin(lod::metric_of(view), view.width_px, view.height_px);
    EXPECT_FALSE(map.hides(behind.corners())) << "begins empty";
}

/// A wall hides what is behind it but for the rows of pixels at its edge.
TEST(OcclusionMap, AWallHidesWhatDoesNotReachOverIt) {
    const lod::View view = view_of(640, 360);
    const double slope_per_px = 1.0 / lod::metric_of(view).lambda_px;
    const Box wall{{0.0, 0.0, -19.5}, glm::dmat3(1.0), {30.0, 2.0, 0.5}};
    lod::OcclusionMap map;
    map.begin(lod::metric_of(view), view.width_px, view.height_px);
    map.add_convex(wall.corners());
    for (const double top_px : {-3.0, -1.5, 1.5, 3.0}) {
        // The wall's upper edge in front is 2 m up, 19 m away; the box begins 40 m away.
        const double half_m = 40.0 * (2.0 / 19.0 + top_px * slope_per_px);
        const Box box{{0.0, 0.0, -41.0}, glm::dmat3(1.0), {4.0, half_m, 1.0}};
        EXPECT_EQ(map.hides(box.corners()), top_px < 0.0) << top_px;
    }
}

TEST(OcclusionMap, WhatReachesThroughTheNearPlaneNeitherHidesNorIsHidden) {
    const lod::View view = view_of(640, 360);
    lod::OcclusionMap map;
    map.begin(lod::metric_of(view), view.width_px, view.height_px);
    map.add_convex(Box{{0.0, 0.0, -1.0}, glm::dmat3(1.0), {9.0, 9.0, 0.6}}.corners());
    const Box behind{{0.0, 0.0, -60.0}, glm::dmat3(1.0), {3.0, 3.0, 3.0}};
    EXPECT_FALSE(map.hides(behind.corners()));
    map.add_convex(Box{{0.0, 0.0, -2.0}, glm::dmat3(1.0), {9.0, 9.0, 0.6}}.corners());
    EXPECT_TRUE(map.hides(behind.corners()));
    EXPECT_FALSE(map.hides(Box{{0.0, 0.0, -60.0}, glm::dmat3(1.0), {3.0, 3.0, 60.0}}.corners()));
}

}  // namespace
