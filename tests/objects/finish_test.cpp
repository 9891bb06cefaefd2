// How faces are lit that stand for many surfaces, and how large they should be: beside what geometry says of a tower.
#include "objects/reduction/finish.h"

#include <gtest/gtest.h>

#include <numbers>

#include "lod/base/rng.h"
#include "tests/objects/boxes.h"
#include "tests/objects/prisms.h"

namespace {

using objects::FaceSoup;
using objects::Outlook;

/// @param keep  whether a face with this normal counts
template <typename Keep>
Outlook outlook_of(const FaceSoup& soup, const Keep& keep) {
    Outlook outlook;
    for (size_t face = 0; face < soup.faces.size(); ++face) {
        const glm::dvec3 area_m2 = lod::area_vector_m2(soup.view().triangle(face));
        if (keep(glm::normalize(area_m2))) outlook.add(area_m2, soup.colours[face]);
    }
    return outlook;
}
Outlook outlook_of(const FaceSoup& soup) {
    return outlook_of(soup, [](const glm::dvec3&) { return true; });
}

TEST(Finish, KindsAreToldApart) {
    EXPECT_TRUE(objects::is_glass({1, 2, 3, objects::kGlass}));
    EXPECT_FALSE(objects::is_all_round({1, 2, 3, objects::kGlass}));
    EXPECT_FALSE(objects::is_all_round({1, 2, 3, objects::kByNormal}));
    for (const double share : {-1.0, 0.0, 0.3, 1.0, 7.0}) {
        const glm::u8vec4 colour(1, 2, 3, objects::all_round(share));
        EXPECT_TRUE(objects::is_all_round(colour));
        EXPECT_FALSE(objects::is_glass(colour));
        EXPECT_NEAR(objects::up_share(colour), std::clamp(share, 0.0, 1.0), 0.002);
    }
}

/// A roof of pi r^2 on walls of 2 pi r h.
TEST(Finish, ATowerLooksAllRoundWithItsRoofsShare) {
    const double radius_m = 3.0, height_m = 12.0;
    const Outlook tower = outlook_of(objects_test::prism(104, radius_m, height_m));
    const glm::u8vec4 colour(0, 0, 0, tower.finish({1, 0, 0}));
    ASSERT_TRUE(objects::is_all_round(colour));
    EXPECT_NEAR(objects::up_share(colour), radius_m / (radius_m + 2.0 * height_m), 0.003);
}

TEST(Finish, WhatLooksOneWayKeepsItsNormal) {
    const FaceSoup tower = objects_test::prism(104, 3.0, 12.0);
    const auto within = [&](double degrees) {
        return outlook_of(tower, [&](const glm::dvec3& normal) {
            return std::abs(normal.z) < 0.5 && normal.x > std::cos(glm::radians(degrees));
        });
    };
    EXPECT_EQ(within(30.0).finish({1, 0, 0}), objects::kByNormal);
    EXPECT_NE(within(90.0).finish({1, 0, 0}), objects::kByNormal);
    FaceSoup plate;
    objects_test::add_box({0, 0, 0}, {0.2, 8, 6}, {9, 9, 9, 255}, plate);
    EXPECT_EQ(outlook_of(plate).finish({2, 0.1, 0}), objects::kByNormal);  // either side of it
    EXPECT_NE(outlook_of(plate).finish({0, 3, 0}), objects::kByNormal);    // across it
    EXPECT_EQ(Outlook{}.finish({0, 0, 1}), objects::kByNormal);
}

/// What has been made of towers before counts as they do.
TEST(Finish, AllRoundStaysAllRound) {
    Outlook two;
    two.add({3, 0, 4}, {0, 0, 0, objects::all_round(0.2)});
    two.add({0, 0, 5}, {0, 0, 0, objects::all_round(0.4)});
    const glm::u8vec4 colour(0, 0, 0, two.finish({0, 0, 1}));
    ASSERT_TRUE(objects::is_all_round(colour));
    EXPECT_NEAR(objects::up_share(colour), 0.3, 0.005);
    EXPECT_DOUBLE_EQ(two.covering_m2(), 10.0);
}

/// Shadows of a convex solid and of a face with what it should have, along random directions.
TEST(Finish, AFaceOfTheCoveringAreaCastsTheMeanShadow) {
    FaceSoup box;
    objects_test::add_box({0, 0, 0}, {7, 4, 20}, {9, 9, 9, 255}, box);
    for (const FaceSoup& solid : {objects_test::prism(12, 4.0, 9.0), box}) {
        const double covering_m2 = outlook_of(solid).covering_m2();
        lod::Rng rng(7);
        double solid_m2 = 0.0, face_m2 = 0.0;
        for (int i = 0; i < 40'000; ++i) {
            const double z = rng.between(-1.0, 1.0), turn = rng.between(0.0, 2.0 * std::numbers::pi);
            const double level = std::sqrt(1.0 - z * z);
            const glm::dvec3 way(level * std::cos(turn), level * std::sin(turn), z);
            for (size_t face = 0; face < solid.faces.size(); ++face)
                solid_m2 += std::max(glm::dot(lod::area_vector_m2(solid.view().triangle(face)), way), 0.0);
            face_m2 += covering_m2 * std::abs(way.x);
        }
        EXPECT_NEAR(face_m2 / solid_m2, 1.0, 0.02);
    }
}

}  // namespace
