// Triangles that are moved to fit: where they end, and that they say when they cannot.
#include "objects/reduction/fit.h"

#include <gtest/gtest.h>

#include "tests/objects/boxes.h"

namespace {

using lod::Triangle;
using objects::FaceSoup;

FaceSoup plate() {
    FaceSoup soup;
    objects_test::add_box({0, 0, 0}, {10, 4, 0.2}, {9, 9, 9, 255}, soup);
    return soup;
}

TEST(Fit, ATriangleComesToASurfaceFromAside) {
    const FaceSoup soup = plate();
    const lod::TriangleTree tree(soup.view());
    Triangle face{{-3, 9, 5}, {4, 12, 4}, {1, 8, 6}};
    ASSERT_TRUE(objects::fit({soup.points, soup.view(), &tree}, 3.0, {&face, 1}));
    for (const glm::dvec3& point : soup.points)
        EXPECT_LE(lod::squared_distance(point, face), 9.0 * 1.01);
    for (const glm::dvec3& corner : {face.a, face.b, face.c})
        EXPECT_LE(tree.nearest(corner).distance_m, 3.0 * 1.01);
}

TEST(Fit, WhatFitsIsHardlyMoved) {
    const FaceSoup soup = plate();
    const lod::TriangleTree tree(soup.view());
    const Triangle before{{0, 0, 0}, {10, 2, 0.1}, {0, 4, 0}};
    Triangle face = before;
    ASSERT_TRUE(objects::fit({soup.points, soup.view(), &tree}, 3.0, {&face, 1}));
    EXPECT_EQ(face.a, before.a);
    EXPECT_EQ(face.b, before.b);
    EXPECT_EQ(face.c, before.c);
}

/// Two plates 30 m apart are too much for one triangle, and not for two.
TEST(Fit, TellsWhatCannotBe) {
    FaceSoup soup = plate();
    objects_test::add_box({0, 34, 0}, {10, 38, 0.2}, {9, 9, 9, 255}, soup);
    const lod::TriangleTree tree(soup.view());
    std::array<Triangle, 2> faces = {Triangle{{0, 0, 0}, {9, 1, 0}, {2, 4, 0}},
                                     Triangle{{0, 33, 0}, {9, 38, 0}, {2, 36, 0}}};
    Triangle alone = faces[0];
    EXPECT_FALSE(objects::fit({soup.points, soup.view(), &tree}, 3.0, {&alone, 1}));
    EXPECT_TRUE(objects::fit({soup.points, soup.view(), &tree}, 3.0, faces));
}

TEST(Fit, CollapsedTrianglesDoNoHarm) {
    const FaceSoup soup = plate();
    const lod::TriangleTree tree(soup.view());
    Triangle dot{{5, 2, 0}, {5, 2, 0}, {5, 2, 0}}, line{{0, 2, 0}, {0, 2, 0}, {9, 2, 0}};
    EXPECT_FALSE(objects::fit({soup.points, soup.view(), &tree}, 1.0, {&dot, 1}));
    EXPECT_TRUE(objects::fit({soup.points, soup.view(), &tree}, 3.0, {&line, 1}));
}

}  // namespace
