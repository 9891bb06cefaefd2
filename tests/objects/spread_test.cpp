// Faces made as broad as they should be: how broad, and that they stay near, by samples.
#include "objects/reduction/spread.h"

#include <gtest/gtest.h>

#include "tests/objects/prisms.h"
#include "tests/objects/sampled_distance.h"

namespace {

using lod::Triangle;
using objects::FaceSoup;
using objects_test::prism;

constexpr double kLimit_m = 3.5;

Triangle spread(const FaceSoup& soup, Triangle face, double wanted_m2) {
    const lod::TriangleTree tree(soup.view());
    objects::spread({soup.points, soup.view(), &tree}, soup.points, kLimit_m, wanted_m2, face);
    return face;
}

double off_m(const FaceSoup& soup, const Triangle& face) {
    const FaceSoup one{{face.a, face.b, face.c}, {{0, 1, 2}}, {{9, 9, 9, 255}}};
    return objects_test::sampled_both_ways_m(one, soup, 0.1);
}

TEST(Spread, WhatIsTooNarrowBecomesBroad) {
    const FaceSoup tower = prism(12, 3.0, 12.0);
    const Triangle sliver{{0, -0.1, 0}, {0, 0.1, 0}, {0, 0, 12}}, segment{{0, 0, 0}, {0, 0, 0}, {0, 0, 12}};
    for (const Triangle& narrow : {sliver, segment}) {
        const Triangle broad = spread(tower, narrow, 30.0);
        EXPECT_NEAR(lod::area_m2(broad), 30.0, 4.5);
        EXPECT_LE(off_m(tower, broad), kLimit_m);
    }
}

TEST(Spread, ACarpetBetweenTowersBecomesNarrow) {
    FaceSoup towers = prism(12, 2.0, 4.0);
    append_soup(prism(12, 2.0, 4.0, {6, 1, 0}), glm::dmat3(1.0), glm::dvec3(0.0), towers);
    const Triangle carpet{{-1, -2, 2}, {8, -1, 2}, {3, 5, 2}};
    ASSERT_LE(off_m(towers, carpet), kLimit_m);
    const Triangle narrow = spread(towers, carpet, 12.0);
    EXPECT_NEAR(lod::area_m2(narrow), 12.0, 1.2);
    EXPECT_LE(off_m(towers, narrow), kLimit_m);
}

/// More than fits is wanted: as much as fits is had.
TEST(Spread, TheLimitIsKept) {
    const FaceSoup tower = prism(12, 3.0, 12.0);
    const Triangle broad = spread(tower, {{0, -1, 0}, {0, 1, 0}, {0, 0, 12}}, 1e4);
    EXPECT_GT(lod::area_m2(broad), 60.0);
    EXPECT_LE(off_m(tower, broad), kLimit_m);
}

}  // namespace
