// What stands for a single part: near enough by another measure, with few faces, and closed where it is a prism.
#include "objects/reduction/stand_in.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "objects/reduction/finish.h"
#include "objects/reduction/outline.h"
#include "tests/objects/boxes.h"
#include "tests/objects/prisms.h"
#include "tests/objects/sampled_distance.h"

namespace {

using objects::FaceSoup;
using objects::Outline;
using objects_test::prism;

/// Against dense samples of both surfaces, which know nothing of proofs.
TEST(StandIn, IsAsNearAsAsked) {
    for (const uint32_t sides : {4u, 12u, 48u, 104u}) {
        const FaceSoup part = prism(sides, 3.25, 12.0);
        for (const double limit_m : {0.3, 0.6, 1.2, 2.4, 3.0, 4.0, 5.0, 7.0}) {
            const FaceSoup found = objects::stand_in(part, limit_m).soup;
            if (found.faces.empty()) continue;
            EXPECT_LE(objects_test::sampled_both_ways_m(part, found, 0.1), limit_m)
                << sides << " within " << limit_m;
        }
    }
}

/// The least prisms that come within a limit of a round one, worked out by hand: a ring of n corners about a circle of radius
/// r is off by r (1 - c) / (1 + c), c = cos(pi / n): 1.08, 0.56, 0.34 and 0.23 m for 3, 4, 5 and 6 at 3.25 m. Above half the
/// radius four leaning walls and a roof do, above 0.8 of it a pair of faces, above all of it one.
TEST(StandIn, TakesTheFewestFacesThatWillDo) {
    const FaceSoup part = prism(104, 3.25, 12.0);
    const auto faces = [&](double limit_m) { return objects::stand_in(part, limit_m).soup.faces.size(); };
    EXPECT_EQ(faces(0.25), 20u);
    EXPECT_EQ(faces(0.36), 16u);
    EXPECT_EQ(faces(0.60), 12u);
    EXPECT_EQ(faces(1.12), 8u);
    EXPECT_EQ(faces(1.55), 8u);
    EXPECT_EQ(faces(1.75), 5u);
    EXPECT_EQ(faces(2.15), 5u);
    EXPECT_EQ(faces(2.40), 4u);
    EXPECT_EQ(faces(2.75), 2u);
    EXPECT_EQ(faces(3.30), 1u);
}

/// Of what a soup covers of the ground: doubled area, one layer of it.
double area_from_above_m2(const FaceSoup& soup) {
    double area_m2 = 0.0;
    for (size_t face = 0; face < soup.faces.size(); ++face) {
        const lod::Triangle t = soup.view().triangle(face);
        area_m2 += 0.5 * std::abs(glm::cross(t.b - t.a, t.c - t.a).z);
    }
    return area_m2;
}

/// A single upright face would be a line to who flies over it.
TEST(StandIn, IsSeenFromAboveWhereTheLimitAllows) {
    const double footprint_m2 = std::numbers::pi * 3.25 * 3.25;
    for (const double limit_m : {5.0, 7.0, 9.0}) {
        const FaceSoup found = objects::stand_in(prism(104, 3.25, 12.0), limit_m).soup;
        ASSERT_EQ(found.faces.size(), 1u);
        EXPECT_GT(area_from_above_m2(found), 0.4 * footprint_m2) << limit_m;
    }
}

TEST(StandIn, WhatIsNoPrismHasNone) {
    FaceSoup corner;  // three plates that meet
    objects_test::add_box({0, 0, 0}, {9, 9, 0.1}, {9, 9, 9, 255}, corner);
    objects_test::add_box({0, 0, 0.1}, {9, 0.1, 9}, {9, 9, 9, 255}, corner);
    EXPECT_TRUE(objects::stand_in(corner, 0.5).soup.faces.empty());
    EXPECT_TRUE(objects::stand_in({}, 0.5).soup.faces.empty());
}

TEST(StandIn, GlassIsNotMixedWithWalls) {
    FaceSoup part = prism(12, 3.25, 12.0);
    part.colours[3].w = objects::kGlass;
    EXPECT_TRUE(objects::stand_in(part, 3.4).soup.faces.empty());
}

TEST(Outline, HullAndRectangleOfATurnedBox) {
    const double cos = std::cos(0.4), sin = std::sin(0.4);
    std::vector<glm::dvec2> points;
    for (const double x : {-3.0, -1.0, 0.5, 3.0}) {
        for (const double y : {-1.0, 0.2, 1.0})
            points.emplace_back(cos * x - sin * y, sin * x + cos * y);
    }
    const Outline hull = objects::convex_outline(points);
    double around_m = 0.0;
    for (size_t i = 0; i < hull.size(); ++i)
        around_m += glm::distance(hull[i], hull[(i + 1) % hull.size()]);
    EXPECT_NEAR(around_m, 16.0, 1e-9);
    const Outline box = objects::least_rectangle(hull);
    ASSERT_EQ(box.size(), 4u);
    EXPECT_NEAR(glm::distance(box[0], box[1]) * glm::distance(box[1], box[2]), 12.0, 1e-9);
    EXPECT_NEAR(objects::corner_distance(hull, box), 0.0, 1e-9);
    EXPECT_EQ(objects::convex_outline(std::vector<glm::dvec2>(5, {1.0, 2.0})).size(), 1u);
}

}  // namespace
