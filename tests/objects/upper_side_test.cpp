#include "objects/reduction/upper_side.h"

#include <gtest/gtest.h>

#include "tests/objects/boxes.h"

namespace {

objects::FaceSoup triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    objects::FaceSoup soup;
    soup.points = {a, b, c};
    soup.faces = {{0, 1, 2}};
    soup.colours = {{90, 90, 90, 255}};
    return soup;
}

TEST(UpperSide, WhatIsOpenAndLooksDownIsTurned) {
    objects::FaceSoup sheet = triangle({0, 0, 0}, {0, 9, 0}, {9, 0, 1});
    objects::turn_open_parts_up(0.01, sheet);
    EXPECT_EQ(sheet.faces[0], (std::array<uint32_t, 3>{0, 2, 1}));
    objects::turn_open_parts_up(0.01, sheet);
    EXPECT_EQ(sheet.faces[0], (std::array<uint32_t, 3>{0, 2, 1}));
}

/// A wall that overhangs a little would have the light of its other side.
TEST(UpperSide, WallsStayAsTheyAre) {
    objects::FaceSoup wall = triangle({0, 0, 0}, {9, 0, 0}, {4, -1, 9});  // faces -y, a little down
    objects::turn_open_parts_up(0.01, wall);
    EXPECT_EQ(wall.faces[0], (std::array<uint32_t, 3>{0, 1, 2}));
}

TEST(UpperSide, ClosedPartsStayAsTheyAre) {
    objects::FaceSoup box;
    objects_test::add_box({0, 0, 0}, {4, 4, 0.1}, {90, 90, 90, 255}, box);
    const objects::FaceSoup before = box;
    objects::turn_open_parts_up(0.01, box);
    EXPECT_EQ(box.faces, before.faces);
}

}  // namespace
