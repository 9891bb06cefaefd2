// Flat faces cut anew: the same surface, by areas and by dense samples; what is not flat, convex and of one colour stays.
#include "objects/reduction/fat_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include "tests/objects/boxes.h"
#include "tests/objects/prisms.h"
#include "tests/objects/sampled_distance.h"

namespace {

using objects::FaceSoup;
using objects_test::prism;

double area_m2(const FaceSoup& soup, size_t face) {
    const lod::Triangle t = soup.view().triangle(face);
    return 0.5 * glm::length(glm::cross(t.b - t.a, t.c - t.a));
}

std::vector<double> areas_of_lid_m2(const FaceSoup& soup, double height_m) {
    std::vector<double> areas;
    for (size_t face = 0; face < soup.faces.size(); ++face) {
        const lod::Triangle t = soup.view().triangle(face);
        if (t.a.z == height_m && t.b.z == height_m && t.c.z == height_m) areas.push_back(area_m2(soup, face));
    }
    std::sort(areas.rbegin(), areas.rend());
    return areas;
}

/// The triangle in a circle's middle holds 3 sqrt(3) / (4 pi) = 0.41 of it, and three more bring it to a hexagon's 0.83; of a fan
/// of 62 the largest hold a thirtieth each.
TEST(FatFaces, AFewTrianglesHoldMostOfALid) {
    const FaceSoup tower = prism(64, 3.0, 8.0);
    const FaceSoup cut = objects::with_fat_faces(tower);
    ASSERT_EQ(cut.faces.size(), tower.faces.size());
    const std::vector<double> before = areas_of_lid_m2(tower, 8.0), after = areas_of_lid_m2(cut, 8.0);
    ASSERT_EQ(after.size(), 62u);
    const auto largest_four = [](const std::vector<double>& areas) {
        return areas[0] + areas[1] + areas[2] + areas[3];
    };
    const double all_m2 = std::numbers::pi * 9.0;
    EXPECT_GT(largest_four(after), 0.75 * all_m2);
    EXPECT_LT(largest_four(before), 0.15 * all_m2);
}

TEST(FatFaces, TheSurfaceIsTheSame) {
    const FaceSoup tower = prism(37, 3.0, 8.0), cut = objects::with_fat_faces(tower);
    EXPECT_LT(objects_test::sampled_both_ways_m(tower, cut, 0.05), 1e-6);
    double before_m2 = 0.0, after_m2 = 0.0;
    glm::dvec3 before_sum(0.0), after_sum(0.0);  // of normals times areas: sides are kept
    for (size_t face = 0; face < tower.faces.size(); ++face) {
        const lod::Triangle a = tower.view().triangle(face), b = cut.view().triangle(face);
        before_m2 += area_m2(tower, face);
        after_m2 += area_m2(cut, face);
        before_sum += glm::cross(a.b - a.a, a.c - a.a) * a.a.z;
        after_sum += glm::cross(b.b - b.a, b.c - b.a) * b.a.z;
    }
    EXPECT_NEAR(before_m2, after_m2, 1e-9 * before_m2);
    EXPECT_NEAR(before_sum.z, after_sum.z, 1e-9 * std::abs(before_sum.z));
}

bool is_untouched(const FaceSoup& soup) {
    return objects::with_fat_faces(soup).faces == soup.faces;
}

TEST(FatFaces, OtherFacesStayAsTheyAre) {
    FaceSoup boxes;
    objects_test::add_box({0, 0, 0}, {9, 9, 1}, {9, 9, 9, 255}, boxes);
    EXPECT_TRUE(is_untouched(boxes));
    EXPECT_TRUE(is_untouched({}));

    FaceSoup dented;  // a fan around a corner that the ring turns in at
    dented.points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {1, 1, 0}, {0, 4, 0}};
    dented.faces = {{0, 1, 3}, {1, 2, 3}, {0, 3, 4}};
    dented.colours.assign(3, {9, 9, 9, 255});
    EXPECT_TRUE(is_untouched(dented));

    FaceSoup spokes;  // a point inside
    for (int i = 0; i < 6; ++i)
        spokes.points.emplace_back(std::cos(i * std::numbers::pi / 3), std::sin(i * std::numbers::pi / 3),
                                   0.0);
    spokes.points.emplace_back(0.0, 0.0, 0.0);
    for (uint32_t i = 0; i < 6; ++i)
        spokes.faces.push_back({6, i, (i + 1) % 6});
    spokes.colours.assign(6, {9, 9, 9, 255});
    EXPECT_TRUE(is_untouched(spokes));

    FaceSoup bent = spokes;
    bent.points.pop_back();
    bent.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
    bent.colours.assign(4, {9, 9, 9, 255});
    EXPECT_FALSE(is_untouched(bent)) << "flat as yet";
    bent.points[3].z = 1e-3;
    EXPECT_TRUE(is_untouched(bent));
    bent.points[3].z = 0.0;
    bent.colours[1].x = 200;
    EXPECT_TRUE(is_untouched(bent)) << "of two colours";
}

}  // namespace
