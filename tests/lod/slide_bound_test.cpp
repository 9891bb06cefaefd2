// The bound of a slide beside dense samples of both stars.
#include "lod/progressive/slide_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lod/base/rng.h"
#include "tests/lod/mesh_distance.h"

namespace {

using lod::OuterEdge;
using Star = std::vector<OuterEdge>;

constexpr double kTurn = 6.283185307179586;

/// Corners around the origin, `count` of them over `turn` radians; closed when that is a whole one.
Star star_around(lod::Rng& rng, uint32_t count, double turn, double height) {
    const bool is_closed = turn == kTurn;
    std::vector<glm::dvec3> corners;
    for (uint32_t i = 0; i < count; ++i) {
        const double share =
            (i + (is_closed ? rng.between(-0.3, 0.3) : 0.0)) / (is_closed ? count : count - 1);
        const double away = rng.between(0.5, 1.5);
        corners.emplace_back(away * std::cos(turn * share), away * std::sin(turn * share),
                             height * rng.between(-1.0, 1.0));
    }
    Star star;
    for (uint32_t i = 0; i + (is_closed ? 0 : 1) < count; ++i) {
        const uint32_t next = (i + 1) % count;
        star.push_back({i, next, corners[i], corners[next]});
    }
    return star;
}

lod_test::Soup soup_of(const glm::dvec3& vertex, const Star& star) {
    lod_test::Soup soup;
    for (const OuterEdge& edge : star)
        soup.push_back({vertex, edge.from_m, edge.to_m});
    return soup;
}

double one_sided_m(const lod_test::Soup& from, const lod_test::Soup& to) {
    constexpr int kSteps = 24;
    double worst = 0.0;
    for (const auto& [a, b, c] : from) {
        for (int i = 0; i <= kSteps; ++i) {
            for (int j = 0; i + j <= kSteps; ++j) {
                const glm::dvec3 sample = a + (b - a) * (double(i) / kSteps) + (c - a) * (double(j) / kSteps);
                double nearest = 1e300;
                for (const auto& triangle : to)
                    nearest =
                        std::min(nearest, glm::distance(sample, lod_test::nearest_on(sample, triangle)));
                worst = std::max(worst, nearest);
            }
        }
    }
    return worst;
}

double departure_m(const glm::dvec3& place, const glm::dvec3& shown, const Star& star) {
    const lod_test::Soup a = soup_of(place, star), b = soup_of(shown, star);
    return std::max(one_sided_m(a, b), one_sided_m(b, a));
}

/// Any slide that has a bound is within it, and many bounds are worth having.
void expect_true(double turn, uint32_t fewest) {
    lod::Rng rng(1);
    int bounded = 0, useful = 0;
    double tightest = 0.0;
    for (int round = 0; round < 400; ++round) {
        const Star star =
            star_around(rng, fewest + static_cast<uint32_t>(rng.below(6)), turn, round % 2 == 0 ? 0.1 : 0.6);
        const glm::dvec3 place(0.05 * rng.between(-1.0, 1.0), 0.05 * rng.between(-1.0, 1.0),
                               0.2 * rng.between(-1.0, 1.0));
        const glm::dvec3 way(rng.between(-0.6, 0.6), rng.between(-0.6, 0.6), rng.between(-0.1, 0.1));
        const std::optional<double> bound = lod::slide_bound_m(place, place + way, star);
        if (!bound) continue;
        ++bounded;
        useful += *bound < glm::length(way);
        const double found = departure_m(place, place + way, star);
        ASSERT_LE(found, *bound + 1e-12) << "round " << round;
        tightest = std::max(tightest, found / *bound);
    }
    EXPECT_GT(bounded, 100);
    EXPECT_GT(useful, 30);
    EXPECT_GT(tightest, 0.5);
}

TEST(SlideBound, HoldsAroundAVertex) {
    expect_true(kTurn, 3);
}

TEST(SlideBound, HoldsAtABorder) {
    expect_true(0.5 * kTurn, 2);
    expect_true(0.4 * kTurn, 2);
    expect_true(0.6 * kTurn, 3);
}

/// A roof: two planes that meet in the line y = 0.
Star roof() {
    const std::vector<glm::dvec3> corners = {{1, 0, 0},  {1, 1, -1},   {-1, 1, -1},
                                             {-1, 0, 0}, {-1, -1, -1}, {1, -1, -1}};
    Star star;
    for (uint32_t i = 0; i < 6; ++i)
        star.push_back({i, (i + 1) % 6, corners[i], corners[(i + 1) % 6]});
    return star;
}

TEST(SlideBound, AlongARidgeNothingChanges) {
    const std::optional<double> along = lod::slide_bound_m({0, 0, 0}, {0.9, 0, 0}, roof());
    ASSERT_TRUE(along);
    EXPECT_LE(*along, 1e-4);
    const std::optional<double> off = lod::slide_bound_m({0, 0, 0}, {0.5, 0.2, 0.0}, roof());
    ASSERT_TRUE(off);
    EXPECT_GE(*off, 0.2 * std::sqrt(0.5)) << "the ridge is cut";
    // Onto a corner, as a vertex that has just been split off is: the triangles between them have no area yet.
    const std::optional<double> onto = lod::slide_bound_m({0, 0, 0}, {1, 0, 0}, roof());
    ASSERT_TRUE(onto);
    EXPECT_LE(*onto, 2e-4);
}

TEST(SlideBound, AlongAStraightBorderNothingChanges) {
    const Star whole = roof(), half(whole.begin(), whole.begin() + 3);
    const std::optional<double> along = lod::slide_bound_m({0, 0, 0}, {-0.9, 0, 0}, half);
    ASSERT_TRUE(along);
    EXPECT_LE(*along, 1e-4);
    const Star one(whole.begin(), whole.begin() + 1);  // a triangle, of which the vertex is one corner
    const std::optional<double> flat = lod::slide_bound_m({0, 0, 0}, {0.1, 0, 0}, one);
    ASSERT_TRUE(flat);
    EXPECT_GE(*flat, 0.1);
}

TEST(SlideBound, NothingIsSaidOfWhatIsNoSurfaceOverOnePolygon) {
    EXPECT_FALSE(lod::slide_bound_m({0, 0, 0}, {1.5, 0, 0}, roof())) << "beyond a corner: turned over";
    EXPECT_FALSE(lod::slide_bound_m({0, 0, 0}, {0, 0, 0}, {}));
    Star flat = roof();
    for (OuterEdge& edge : flat)
        edge.from_m.y = edge.to_m.y = 0.0;
    EXPECT_FALSE(lod::slide_bound_m({0, 0, 0}, {0.5, 0, 0}, flat)) << "no area";
    Star twice = roof();
    for (const OuterEdge& edge : roof())
        twice.push_back({edge.from + 6, edge.to + 6, edge.from_m, edge.to_m});
    EXPECT_FALSE(lod::slide_bound_m({0, 0, 0}, {0.5, 0, 0}, twice)) << "two sheets that meet in a vertex";
    Star apart = roof();
    apart.erase(apart.begin() + 3);
    apart.erase(apart.begin());
    EXPECT_FALSE(lod::slide_bound_m({0, 0, 0}, {0.5, 0, 0}, apart)) << "two fans";
}

/// Goes round twice in one ring: over its own polygon everywhere, yet no surface over it.
TEST(SlideBound, NothingIsSaidOfASpiral) {
    Star star;
    constexpr uint32_t kCorners = 10;
    const auto corner = [](uint32_t i) {
        return glm::dvec3(std::cos(2 * kTurn * i / kCorners), std::sin(2 * kTurn * i / kCorners),
                          0.3 * (i % 5));
    };
    for (uint32_t i = 0; i < kCorners; ++i)
        star.push_back({i, (i + 1) % kCorners, corner(i), corner((i + 1) % kCorners)});
    EXPECT_FALSE(lod::slide_bound_m({0, 0, 0}, {0.1, 0, 0}, star));
}

}  // namespace
