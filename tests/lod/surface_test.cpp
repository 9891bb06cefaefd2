// The surface distance against a brute-force twin: points everywhere, nearest points by minimisation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lod/surface/surface_distance.h"
#include "tests/lod/soups.h"

namespace {

using lod_test::OwnedSoup;

/// Distance to a triangle by minimising over its parameters: for every point of edge ab a nearest point on the line
/// to c, by golden section, since the distance is convex in both.
double twin_distance(const glm::dvec3& point, const lod::Triangle& t) {
    const auto along = [](const auto& f) {
        double low = 0.0, high = 1.0;
        for (int i = 0; i < 60; ++i) {
            const double a = low + (high - low) * 0.382, b = low + (high - low) * 0.618;
            (f(a) <= f(b) ? high : low) = f(a) <= f(b) ? b : a;
        }
        return std::min({f(0.0), f(1.0), f(0.5 * (low + high))});
    };
    return along([&](double u) {
        const glm::dvec3 base = t.a + u * (t.b - t.a);
        return along([&](double v) { return glm::length(point - (base + v * (t.c - base))); });
    });
}

template <typename Visit>
void for_samples(const lod::Triangle& t, int steps, const Visit& visit) {
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; i + j <= steps; ++j)
            visit(t.a + (double(i) / steps) * (t.b - t.a) + (double(j) / steps) * (t.c - t.a));
    }
}

/// From below: samples, each against every triangle.
double sampled_distance(const lod::Soup& from, const lod::Soup& to, int steps) {
    double largest = 0.0;
    for (size_t i = 0; i < from.triangles.size(); ++i) {
        for_samples(from.triangle(i), steps, [&](const glm::dvec3& point) {
            double nearest = std::numeric_limits<double>::infinity();
            for (size_t k = 0; k < to.triangles.size(); ++k)
                nearest = std::min(nearest, lod::squared_distance(point, to.triangle(k)));
            largest = std::max(largest, std::sqrt(nearest));
        });
    }
    return largest;
}

TEST(Surface, NearestPointIsInTheTriangleAndNearest) {
    lod::Rng rng(1);
    for (int i = 0; i < 400; ++i) {
        const OwnedSoup soup = lod_test::random_soup(rng, 1, 2.0, i % 3 == 0 ? 1e-3 : 2.0);
        lod::Triangle t = soup.view().triangle(0);
        if (i % 7 == 0) t.c = t.b;
        if (i % 7 == 1) t.c = t.a + 0.3 * (t.b - t.a);
        if (i % 21 == 2) t.b = t.c = t.a;
        const glm::dvec3 point = lod_test::random_point(rng, 3.0);
        const glm::dvec3 nearest = lod::nearest_on_triangle(point, t);
        EXPECT_NEAR(glm::length(point - nearest), twin_distance(point, t), 1e-7) << i;
        EXPECT_LT(twin_distance(nearest, t), 1e-7) << i;
    }
}

TEST(Surface, HandWorkedTriangle) {
    const lod::Triangle t{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}};
    EXPECT_EQ(lod::nearest_on_triangle({1, 1, 5}, t), glm::dvec3(1, 1, 0));    // above the inside
    EXPECT_EQ(lod::nearest_on_triangle({-1, -2, 0}, t), glm::dvec3(0, 0, 0));  // corner a
    EXPECT_EQ(lod::nearest_on_triangle({2, -2, 1}, t), glm::dvec3(2, 0, 0));   // edge ab
    EXPECT_EQ(lod::nearest_on_triangle({9, -1, 0}, t), glm::dvec3(4, 0, 0));   // corner b
    EXPECT_NEAR(glm::length(lod::nearest_on_triangle({4, 3, 0}, t) - glm::dvec3(4, 3, 0)), 2.4, 1e-15);
}

TEST(Surface, TreeFindsTheNearestOfAll) {
    lod::Rng rng(2);
    const OwnedSoup soup = lod_test::random_soup(rng, 500, 10.0, 1.0);
    const lod::TriangleTree tree(soup.view());
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 point = lod_test::random_point(rng, 12.0);
        double nearest = 1e9;
        for (size_t k = 0; k < soup.triangles.size(); ++k)
            nearest = std::min(nearest,
                               glm::length(point - lod::nearest_on_triangle(point, soup.view().triangle(k))));
        EXPECT_EQ(tree.nearest(point).distance_m, nearest);
        EXPECT_EQ(tree.nearest(point, 0.9 * nearest).triangle, 0xffffffffu);
    }
}

TEST(Surface, BoundsHoldBesideDenseSamples) {
    lod::Rng rng(3);
    for (int trial = 0; trial < 12; ++trial) {
        const OwnedSoup a = lod_test::random_soup(rng, 40, 4.0, 3.0);
        const OwnedSoup b = lod_test::random_soup(rng, 30, 4.0, 3.0);
        for (const double slack : {0.5, 0.02}) {
            const lod::DistanceBounds bounds = lod::two_sided_distance(a.view(), b.view(), slack, 1);
            const double sampled =
                std::max(sampled_distance(a.view(), b.view(), 24), sampled_distance(b.view(), a.view(), 24));
            EXPECT_LE(sampled, bounds.upper_m);
            EXPECT_LE(bounds.upper_m - bounds.lower_m, slack);
            EXPECT_LE(bounds.lower_m, sampled + 3.0 * 1.5 / 24);  // samples are that near to any point
        }
    }
}

TEST(Surface, AHoleIsSeenFromOneSideOnly) {
    const OwnedSoup whole = lod_test::bumpy_square(12, 0.0, 0, 0);
    const OwnedSoup holed = lod_test::bumpy_square(12, 0.0, 4, 8);
    const lod::DistanceBounds out =
        lod::one_sided_distance(holed.view(), lod::TriangleTree(whole.view()), 1e-3, 1);
    EXPECT_EQ(out.upper_m, 0.0);
    const lod::DistanceBounds in =
        lod::one_sided_distance(whole.view(), lod::TriangleTree(holed.view()), 1e-3, 1);
    EXPECT_LE(in.lower_m, 2.0);  // the middle of a hole of 4 x 4
    EXPECT_GE(in.upper_m, 2.0);
    EXPECT_LE(in.upper_m - in.lower_m, 1e-3);
}

/// Against every triangle, each by the signs of volumes.
TEST(Surface, TheFirstOnAWayIsTheFirstOfAll) {
    lod::Rng rng(7);
    const auto point = [&](double reach) {
        return glm::dvec3(rng.between(-reach, reach), rng.between(-reach, reach), rng.between(-reach, reach));
    };
    std::vector<glm::dvec3> points;
    std::vector<std::array<uint32_t, 3>> faces;
    for (uint32_t i = 0; i < 120; ++i) {
        const glm::dvec3 at = point(5.0);
        for (int corner = 0; corner < 3; ++corner)
            points.push_back(at + point(1.0));
        faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const lod::Soup soup{points, faces};
    const lod::TriangleTree tree(soup);
    const auto volume = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                           const glm::dvec3& d) { return glm::dot(glm::cross(b - a, c - a), d - a); };
    size_t met = 0;
    for (int i = 0; i < 2000; ++i) {
        glm::dvec3 from = point(6.0), to = from + point(4.0);
        if (i % 5 == 0) to.x = from.x;
        double first_m = std::numeric_limits<double>::infinity();
        for (size_t face = 0; face < faces.size(); ++face) {
            const lod::Triangle t = soup.triangle(face);
            const double ab = volume(from, to, t.a, t.b), bc = volume(from, to, t.b, t.c),
                         ca = volume(from, to, t.c, t.a);
            const bool is_around = (ab > 0.0) == (bc > 0.0) && (bc > 0.0) == (ca > 0.0);
            const double before = volume(t.a, t.b, t.c, from), behind = volume(t.a, t.b, t.c, to);
            if (is_around && before * behind < 0.0)
                first_m = std::min(first_m, glm::distance(from, to) * before / (before - behind));
        }
        const lod::TriangleHit hit = tree.first_on_way(from, to);
        ASSERT_EQ(hit.triangle < faces.size(), std::isfinite(first_m)) << i;
        ASSERT_EQ(tree.is_on_way(from, to), std::isfinite(first_m)) << i;
        if (!std::isfinite(first_m)) continue;
        EXPECT_NEAR(hit.distance_m, first_m, 1e-9) << i;
        ++met;
    }
    EXPECT_GT(met, 100u);
    EXPECT_LT(met, 1800u);
}

TEST(Surface, EmptySurfaces) {
    const OwnedSoup none, some = lod_test::bumpy_square(2, 0.0, 0, 0);
    EXPECT_EQ(lod::two_sided_distance(none.view(), none.view(), 1.0, 1).upper_m, 0.0);
    EXPECT_TRUE(std::isinf(lod::two_sided_distance(none.view(), some.view(), 1.0, 1).lower_m));
    EXPECT_TRUE(std::isinf(lod::two_sided_distance(some.view(), none.view(), 1.0, 1).upper_m));
}

TEST(Surface, SameBoundsForAnyNumberOfThreads) {
    const OwnedSoup a = lod_test::bumpy_square(30, 0.4, 0, 0), b = lod_test::bumpy_square(31, 0.3, 3, 6);
    const lod::DistanceBounds one = lod::two_sided_distance(a.view(), b.view(), 0.01, 1);
    for (unsigned threads : {2u, 3u, 7u}) {
        const lod::DistanceBounds more = lod::two_sided_distance(a.view(), b.view(), 0.01, threads);
        EXPECT_EQ(one.lower_m, more.lower_m);
        EXPECT_EQ(one.upper_m, more.upper_m);
    }
}

TEST(Surface, TrianglesBeyondALimitAreNamed) {
    lod::Rng rng(4);
    const OwnedSoup a = lod_test::random_soup(rng, 300, 10.0, 2.0);
    const OwnedSoup b = lod_test::random_soup(rng, 100, 10.0, 2.0);
    const lod::TriangleTree tree(b.view());
    for (const double limit : {0.3, 0.7, 1.0}) {
        std::vector<uint32_t> named;
        lod::find_beyond(a.view(), tree, limit, named);
        size_t beyond = 0;
        for (uint32_t i = 0; i < a.triangles.size(); ++i) {
            const std::array<std::array<uint32_t, 3>, 1> one = {a.triangles[i]};
            const double sampled = sampled_distance({a.points, one}, b.view(), 12);
            const bool is_named = std::binary_search(named.begin(), named.end(), i);
            beyond += sampled > limit;
            EXPECT_TRUE(is_named || sampled <= limit) << i;
            if (is_named) {
                EXPECT_GT(lod::one_sided_distance({a.points, one}, tree, limit / 100, 1).upper_m,
                          limit * 0.95)
                    << i;
            }
        }
        EXPECT_GT(beyond, 0u);
        EXPECT_LE(named.size(), beyond + 12);
    }
}

}  // namespace
