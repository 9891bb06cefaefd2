#include "data/outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data/stroke_font.h"

namespace data {
namespace {

/// Area by the shoelace formula over the rings, which the triangles must cover exactly.
double ring_area(const Shape& shape) {
    double twice = 0.0;
    for (const Outline& outline : shape) {
        for (const Polyline& ring : outline.rings) {
            for (size_t i = 0; i < ring.size(); ++i) {
                const glm::dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
                twice += a.x * b.y - a.y * b.x;
            }
        }
    }
    return twice / 2.0;
}

void expect_all_counter_clockwise(const Shape& shape) {
    for (const Outline& outline : shape) {
        Polyline points;
        for (const Polyline& ring : outline.rings)
            points.insert(points.end(), ring.begin(), ring.end());
        EXPECT_EQ(outline.triangles.size(), points.size() + 2 * outline.rings.size() - 4);
        for (const auto& [a, b, c] : outline.triangles) {
            const glm::dvec2 u = points[b] - points[a], v = points[c] - points[a];
            EXPECT_GT(u.x * v.y - u.y * v.x, 0.0);
        }
    }
}

TEST(Outline, AStrokeIsARectangleWithRoundEnds) {
    const Polyline line{{0.0, 0.0}, {0.0, 10.0}};
    const Shape shape = stroke_shape({&line, 1}, 2.0, 64);
    ASSERT_EQ(shape.size(), 1u);
    EXPECT_NEAR(area_of(shape), 20.0 + std::numbers::pi, 1e-3);
    EXPECT_NEAR(area_of(shape), ring_area(shape), 1e-9);
    expect_all_counter_clockwise(shape);
}

TEST(Outline, HolesTurnTheOtherWay) {
    const Shape plate = ring_shape(rounded_rectangle({1.0, 2.0}, {5.0, 4.0}, 0.0, 0));
    EXPECT_NEAR(area_of(plate), 80.0, 1e-12);
    const Shape window = subtract(plate, ring_shape(circle({1.0, 2.0}, 2.0, 6)));
    ASSERT_EQ(window.size(), 1u);
    ASSERT_EQ(window[0].rings.size(), 2u);
    const double hexagon = 1.5 * std::sqrt(3.0) * 4.0;
    EXPECT_NEAR(area_of(window), 80.0 - hexagon, 1e-9);
    EXPECT_NEAR(ring_area(window), 80.0 - hexagon, 1e-9);
    expect_all_counter_clockwise(window);
}

TEST(Outline, RingsMayComeInEitherDirection) {
    Polyline ring = circle({0.0, 0.0}, 1.0, 12);
    const double area = area_of(ring_shape(ring));
    std::reverse(ring.begin(), ring.end());
    EXPECT_EQ(area_of(ring_shape(ring)), area);
    EXPECT_NEAR(area, 3.0, 1e-12);
}

TEST(Outline, UnitesAndSeparates) {
    const Shape left = ring_shape(rounded_rectangle({0, 0}, {2, 1}, 0, 0));
    const Shape right = ring_shape(rounded_rectangle({3, 0}, {2, 1}, 0, 0));
    EXPECT_NEAR(area_of(unite(left, right)), 14.0, 1e-12);
    const Shape cut = ring_shape(rounded_rectangle({0, 0}, {0.5, 5}, 0, 0));
    EXPECT_EQ(subtract(left, cut).size(), 2u);
    EXPECT_NEAR(area_of(subtract(left, cut)), 6.0, 1e-12);
    EXPECT_NEAR(area_of(moved(left, {7, 7}, 0.5)), 2.0, 1e-12);
    EXPECT_NEAR(area_of(ring_shape(rounded_rectangle({0, 0}, {3, 2}, 1.0, 64))),
                24.0 - 4.0 + std::numbers::pi, 1e-3);
}

TEST(StrokeFont, EveryDigitIsOnePieceOfItsOwnShape) {
    const int holes[10] = {1, 0, 0, 0, 1, 0, 1, 0, 2, 1};
    for (int digit = 0; digit < 10; ++digit) {
        const char text[2] = {static_cast<char>('0' + digit), 0};
        const Shape shape = text_shape(text, {0.0, 0.0}, 1.0, 0.16);
        ASSERT_EQ(shape.size(), 1u) << digit;
        EXPECT_EQ(shape[0].rings.size(), static_cast<size_t>(1 + holes[digit])) << digit;
        expect_all_counter_clockwise(shape);
        for (const glm::dvec2& point : shape[0].rings[0]) {
            EXPECT_LE(std::abs(point.y), 0.581) << digit;
            EXPECT_LE(std::abs(point.x), 0.381) << digit;
        }
    }
}

TEST(StrokeFont, TextIsCentredAndSkipsWhatItDoesNotKnow) {
    double low = 1e9, high = -1e9;
    for (const Outline& letter : text_shape("HIH", {5.0, 1.0}, 2.0, 0.1)) {
        for (const glm::dvec2& point : letter.rings[0]) {
            low = std::min(low, point.x);
            high = std::max(high, point.x);
        }
    }
    EXPECT_NEAR((low + high) / 2.0, 5.0, 1e-9);
    EXPECT_TRUE(text_shape("", {0, 0}, 1.0, 0.1).empty());
    EXPECT_EQ(text_shape("~1~", {0, 0}, 1.0, 0.1).size(), 1u);
}

}  // namespace
}  // namespace data
