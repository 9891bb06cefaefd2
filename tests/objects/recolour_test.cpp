#include "objects/reduction/recolour.h"

#include <gtest/gtest.h>

#include "objects/reduction/finish.h"

namespace objects {
namespace {

/// A rectangle in the plane y = depth, facing -y.
void add_rectangle(glm::dvec2 low, glm::dvec2 high, double depth, glm::u8vec4 colour, FaceSoup& soup) {
    const auto first = static_cast<uint32_t>(soup.points.size());
    for (const glm::dvec2 p : {low, glm::dvec2(high.x, low.y), high, glm::dvec2(low.x, high.y)})
        soup.points.emplace_back(p.x, depth, p.y);
    soup.faces.push_back({first, first + 1, first + 2});
    soup.faces.push_back({first, first + 2, first + 3});
    soup.colours.insert(soup.colours.end(), 2, colour);
}

TEST(Recolour, WallsDarkenByTheWindowsTheyStandFor) {
    FaceSoup house;
    // Bands of window and of wall, two metres each, ten metres wide.
    for (int band = 0; band < 10; ++band) {
        const glm::u8vec4 colour =
            band % 2 == 0 ? glm::u8vec4(200, 200, 200, 255) : glm::u8vec4(40, 40, 80, 255);
        add_rectangle({0.0, 2.0 * band}, {10.0, 2.0 * band + 2.0}, 0.0, colour, house);
    }
    FaceSoup wall;
    add_rectangle({0.0, 0.0}, {10.0, 20.0}, 0.05, {200, 200, 200, 255}, wall);
    recolour(house, lod::TriangleTree(house.view()), nearest_faces(house, wall, 0.2), 0.2, wall);
    // Light, not numbers: sqrt((200² + 40²) / 2) = 144, sqrt((200² + 80²) / 2) = 152.
    for (const glm::u8vec4& colour : wall.colours) {
        EXPECT_NEAR(colour.x, 144, 8);
        EXPECT_NEAR(colour.z, 152, 8);
        EXPECT_EQ(colour.w, 255);
    }
}

/// A wall that is dark below has one colour, not one above its diagonal and one below.
TEST(Recolour, HalvesOfAWallAreAlike) {
    FaceSoup house, wall;
    add_rectangle({0.0, 0.0}, {10.0, 4.0}, 0.0, {40, 40, 80, 255}, house);
    add_rectangle({0.0, 4.0}, {10.0, 12.0}, 0.0, {200, 200, 200, 255}, house);
    add_rectangle({0.0, 0.0}, {10.0, 12.0}, 0.05, {200, 200, 200, 255}, wall);
    add_rectangle({10.0, 0.0}, {20.0, 12.0}, 0.05, {9, 9, 9, 255}, wall);  // its neighbour keeps its own
    recolour(house, lod::TriangleTree(house.view()), nearest_faces(house, wall, 0.2), 0.2, wall);
    EXPECT_EQ(wall.colours[0], wall.colours[1]);
    EXPECT_NEAR(wall.colours[0].x, 165, 8);  // sqrt((2 * 200² + 40²) / 3)
    EXPECT_EQ(wall.colours[2], glm::u8vec4(9, 9, 9, 255));
}

/// Two halves of a wall, one of which contraction has turned over; and a wall that is seen from both sides alike.
TEST(Recolour, WhatShowsItsBackIsTurnedOver) {
    FaceSoup house, wall;
    add_rectangle({0.0, 0.0}, {10.0, 4.0}, 0.0, {40, 40, 80, 255}, house);
    add_rectangle({0.0, 4.0}, {10.0, 12.0}, 0.0, {200, 200, 200, 255}, house);
    add_rectangle({0.0, 0.0}, {10.0, 12.0}, 0.05, {200, 200, 200, 255}, wall);
    const FaceSoup before = wall;
    std::swap(wall.faces[1][1], wall.faces[1][2]);
    recolour(house, lod::TriangleTree(house.view()), nearest_faces(house, wall, 0.2), 0.2, wall);
    EXPECT_EQ(wall.faces, before.faces);
    EXPECT_EQ(wall.colours[0], wall.colours[1]);

    for (const size_t face : {0u, 1u, 2u, 3u}) {
        const auto [a, b, c] = house.faces[face];
        house.faces.push_back({a, c, b});
        house.colours.push_back(house.colours[face]);
    }
    wall = before;
    std::swap(wall.faces[0][1], wall.faces[0][2]);
    const FaceSoup as_it_is = wall;
    recolour(house, lod::TriangleTree(house.view()), nearest_faces(house, wall, 0.2), 0.2, wall);
    EXPECT_EQ(wall.faces, as_it_is.faces);
}

/// Bands of windows on a wall that is one face: a few points would all meet windows, or none.
TEST(Recolour, BandsOfWindowsAreMetByTheirShare) {
    for (int bands = 3; bands < 25; ++bands) {
        FaceSoup house, wall;
        const double storey_m = 36.0 / bands;
        add_rectangle({0.0, 0.0}, {20.0, 36.0}, 0.0, {200, 200, 200, 255}, house);
        for (int band = 0; band < bands; ++band)
            add_rectangle({0.0, storey_m * band}, {20.0, storey_m * (band + 0.5)}, -0.05, {40, 40, 80, 255},
                          house);
        add_rectangle({0.0, 0.0}, {20.0, 36.0}, 0.3, {200, 200, 200, 255}, wall);
        recolour(house, lod::TriangleTree(house.view()), nearest_faces(house, wall, 4.0), 4.0, wall);
        EXPECT_NEAR(wall.colours[0].x, 144, 16) << bands;  // sqrt((200² + 40²) / 2)
        EXPECT_EQ(wall.colours[0], wall.colours[1]);
    }
}

/// A pane on a wall, a roof on a house: what they hide is not seen.
TEST(Recolour, WhatIsHiddenDoesNotCount) {
    FaceSoup layers;
    add_rectangle({0.0, 0.0}, {10.0, 10.0}, 0.00, {250, 0, 0, 255}, layers);  // a wall, whole
    add_rectangle({2.5, 2.5}, {7.5, 7.5}, -0.02, {0, 0, 250, 255}, layers);   // a pane over a quarter of it
    add_rectangle({0.0, 0.0}, {10.0, 10.0}, 0.10, {0, 250, 0, 255}, layers);  // the room's side
    std::swap(layers.faces[4][1], layers.faces[4][2]);
    std::swap(layers.faces[5][1], layers.faces[5][2]);
    for (const bool is_turned : {false, true}) {
        FaceSoup sheet;
        add_rectangle({0.0, 0.0}, {10.0, 10.0}, 0.05, {9, 9, 9, 255}, sheet);
        if (is_turned) {
            std::swap(sheet.faces[0][1], sheet.faces[0][2]);
            std::swap(sheet.faces[1][1], sheet.faces[1][2]);
        }
        recolour(layers, lod::TriangleTree(layers.view()), nearest_faces(layers, sheet, 0.2), 0.2, sheet);
        for (const glm::u8vec4& colour : sheet.colours) {
            EXPECT_EQ(colour.y, is_turned ? 250 : 0);
            EXPECT_NEAR(colour.x, is_turned ? 0 : 216, 12);  // sqrt(3 / 4) of 250
            EXPECT_NEAR(colour.z, is_turned ? 0 : 125, 12);  // sqrt(1 / 4)
        }
    }
}

TEST(Recolour, WhatIsFarOrFacesElsewhereDoesNotCount) {
    FaceSoup source;
    add_rectangle({0.0, 0.0}, {10.0, 20.0}, 3.0, {255, 0, 0, 255}, source);              // beyond the limit
    add_rectangle({0.0, 0.0}, {10.0, 20.0}, 0.1, {0, 255, 0, objects::kGlass}, source);  // glass
    FaceSoup wall;
    add_rectangle({0.0, 0.0}, {10.0, 20.0}, 0.0, {10, 20, 30, 255}, wall);
    recolour(source, lod::TriangleTree(source.view()), nearest_faces(source, wall, 0.5), 0.5, wall);
    for (const glm::u8vec4& colour : wall.colours)
        EXPECT_EQ(colour, glm::u8vec4(10, 20, 30, 255));
    FaceSoup pane;
    add_rectangle({0.0, 0.0}, {10.0, 20.0}, 3.1, {10, 20, 30, objects::kGlass},
                  pane);  // takes no colour of a wall's
    recolour(source, lod::TriangleTree(source.view()), nearest_faces(source, pane, 0.5), 0.5, pane);
    for (const glm::u8vec4& colour : pane.colours)
        EXPECT_EQ(colour, glm::u8vec4(10, 20, 30, objects::kGlass));
}

}  // namespace
}  // namespace objects
