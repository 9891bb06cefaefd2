// Thin slabs beside the thinnest there is, which stands across two edges between some of the points.
#include "objects/reduction/width.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "lod/base/rng.h"

namespace {

using Points = std::vector<glm::dvec3>;

double extent_m(const Points& points, const glm::dvec3& normal) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const glm::dvec3& point : points) {
        low = std::min(low, glm::dot(normal, point));
        high = std::max(high, glm::dot(normal, point));
    }
    return high - low;
}

/// Of a polytope the thinnest slab touches a face and a corner, or two edges: its normal is across two edges either way.
double thinnest_m(const Points& points) {
    std::vector<glm::dvec3> edges;
    for (size_t i = 0; i < points.size(); ++i) {
        for (size_t k = i + 1; k < points.size(); ++k)
            edges.push_back(points[k] - points[i]);
    }
    double least_m = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < edges.size(); ++i) {
        for (size_t k = i + 1; k < edges.size(); ++k) {
            const glm::dvec3 across = glm::cross(edges[i], edges[k]);
            if (glm::length(across) < 1e-9) continue;
            least_m = std::min(least_m, extent_m(points, glm::normalize(across)));
        }
    }
    return least_m;
}

TEST(Width, OfPointsLinesAndPlates) {
    EXPECT_EQ(objects::least_width_m(Points{{3, 4, 5}}), 0.0);
    EXPECT_NEAR(objects::least_width_m(Points{{3, 4, 5}, {9, 4, 7}, {6, 4, 6}}), 0.0, 1e-6);
    EXPECT_NEAR(objects::least_width_m(Points{{0, 0, 0}, {9, 0, 9}, {0, 5, 0}, {9, 5, 9}}), 0.0, 1e-6);
}

/// Two towers side by side, as they are when they are asked for one face.
TEST(Width, IsTrueAndHardlyMoreThanTheThinnest) {
    lod::Rng rng(11);
    int near = 0;
    constexpr int kRounds = 200;
    for (int round = 0; round < kRounds; ++round) {
        Points points;
        for (const double aside_m : {0.0, rng.between(6.0, 14.0)}) {
            const double radius_m = rng.between(1.0, 5.0), height_m = rng.between(2.0, 20.0);
            for (int corner = 0; corner < 3; ++corner) {
                const double angle = rng.between(0.0, 6.28);
                for (const double z : {0.0, height_m})
                    points.emplace_back(aside_m + radius_m * std::cos(angle), radius_m * std::sin(angle), z);
            }
        }
        const double found_m = objects::least_width_m(points), thinnest = thinnest_m(points);
        ASSERT_GE(found_m, thinnest - 1e-9);
        near += found_m < 1.05 * thinnest;
    }
    std::printf("within a twentieth: %d of %d\n", near, kRounds);
    EXPECT_GE(near, 9 * kRounds / 10);
}

}  // namespace
