// Proved errors against dense samples measured by CGAL, which shares nothing with the proof.
#include <gtest/gtest.h>

#include <cmath>

#include "objects/reduction/reduce.h"
#include "tests/objects/boxes.h"
#include "tests/objects/sampled_distance.h"
#include "tests/objects/small_scenes.h"
#include "tests/objects/tree_surfaces.h"

namespace {

using objects::FaceSoup;
using objects_test::sampled_both_ways_m;

TEST(ReduceWithin, AFrameBuildingComesDownWithinItsLimits) {
    const FaceSoup building = objects_test::frame_building(3, 2);
    const std::pair<double, size_t> limits[] = {{0.1, 2}, {0.4, 12}};
    for (const auto& [limit_m, at_least] : limits) {
        const FaceSoup reduced = objects::reduce_within(building, limit_m);
        EXPECT_LE(sampled_both_ways_m(building, reduced, 0.4), limit_m + 1e-9);
        EXPECT_LE(reduced.faces.size() * at_least, building.faces.size()) << limit_m;
    }
}

TEST(ReduceWithin, ABallKeepsItsShape) {
    const FaceSoup ball = objects_test::ball(1.0, 20, 30, {1, 2, 3, 255});
    for (double limit_m : {0.02, 0.1}) {
        const FaceSoup reduced = objects::reduce_within(ball, limit_m);
        EXPECT_LE(sampled_both_ways_m(ball, reduced, 0.05), limit_m + 1e-9);
        EXPECT_LT(reduced.faces.size(), ball.faces.size() / 2);
        for (const glm::u8vec4& colour : reduced.colours)
            EXPECT_EQ(colour, glm::u8vec4(1, 2, 3, 255));
    }
}

/// What a ray from above meets first, and all that lies there with it: whether none of it looks down.
bool is_top_lit_from_above(const FaceSoup& soup, const glm::dvec2& at) {
    double top_m = -1e30;
    bool is_lit = true;
    for (size_t face = 0; face < soup.faces.size(); ++face) {
        const lod::Triangle t = soup.view().triangle(face);
        const glm::dvec3 normal = glm::cross(t.b - t.a, t.c - t.a);
        const auto side = [&at](const glm::dvec3& a, const glm::dvec3& b) {
            return (b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x);
        };
        const double ab = side(t.a, t.b), bc = side(t.b, t.c), ca = side(t.c, t.a);
        if (!((ab > 0.0 && bc > 0.0 && ca > 0.0) || (ab < 0.0 && bc < 0.0 && ca < 0.0))) continue;
        const double z_m = t.a.z - (normal.x * (at.x - t.a.x) + normal.y * (at.y - t.a.y)) / normal.z;
        if (z_m > top_m + 1e-6) is_lit = true;
        if (z_m > top_m - 1e-6) is_lit = is_lit && normal.z > 0.0;
        top_m = std::max(top_m, z_m);
    }
    return is_lit;
}

/// Lawns, roads, roofs: slabs side by side keep the light of their upper sides, however flat they are pressed.
TEST(ReduceWithin, SlabsAreLitFromAbove) {
    FaceSoup ground;
    for (int x = 0; x < 3; ++x) {
        for (int y = 0; y < 3; ++y)
            objects_test::add_box({84.0 * x, 84.0 * y, -0.3}, {84.0 * (x + 1), 84.0 * (y + 1), 0.0},
                                  {90, 120, 60, 255}, ground);
    }
    for (const double limit_m : {0.2, 0.5, 1.0, 4.0}) {
        const FaceSoup reduced = objects::reduce_within(ground, limit_m);
        EXPECT_LE(sampled_both_ways_m(ground, reduced, 4.0), limit_m + 1e-9);
        for (double x = 1.37; x < 250.0; x += 7.3) {
            for (double y = 1.71; y < 250.0; y += 7.9)
                ASSERT_TRUE(is_top_lit_from_above(reduced, {x, y})) << limit_m << " at " << x << ", " << y;
        }
    }
}

/// A road, a roof: one side of a slab, however it leans.
TEST(ReduceWithin, WhatStandsForASlabLooksUp) {
    for (const double lean : {0.0, 0.02, -0.02, 3.14}) {
        FaceSoup slab;
        objects_test::add_box({-20, -12, -0.1}, {20, 12, 0.1}, {90, 120, 60, 255}, slab);
        for (glm::dvec3& p : slab.points)
            p = {p.x, std::cos(lean) * p.y - std::sin(lean) * p.z,
                 std::sin(lean) * p.y + std::cos(lean) * p.z};
        const FaceSoup found = objects::reduce_within(slab, 1.0);
        ASSERT_EQ(found.faces.size(), 2u);
        EXPECT_TRUE(is_top_lit_from_above(found, {3.1, 2.3})) << lean;
        EXPECT_TRUE(is_top_lit_from_above(found, {-3.1, -2.3})) << lean;
    }
}

TEST(ReduceWithin, HopelessSoupsStayWhole) {
    FaceSoup point;
    point.points = {{1, 1, 1}};
    point.faces = {{0, 0, 0}};
    point.colours = {{1, 1, 1, 255}};
    EXPECT_EQ(objects::reduce_within(point, 0.5).faces.size(), 1u);
    EXPECT_TRUE(objects::reduce_within({}, 0.5).faces.empty());
    const FaceSoup box = objects_test::box({10, 10, 10}, {1, 1, 1, 255});
    EXPECT_LE(sampled_both_ways_m(box, objects::reduce_within(box, 0.01), 0.2), 0.01);
}

TEST(ClusterError, HoldsForEveryClusterOfSomeScenes) {
    size_t judged = 0, reduced = 0;
    double closest = 0.0;
    for (uint64_t seed : {5u, 11u}) {
        const data::TimedScene scene = objects_test::small_scene(
            {.objects = 100, .seed = seed, .moving_share = 0.05, .side_m = seed == 11 ? 20.0 : 60.0});
        const objects::ClusterTree tree = objects_test::build(scene);
        for (objects::ClusterId id = 0; id < tree.clusters.size(); ++id) {
            const objects::Cluster& c = tree.clusters[id];
            if (c.child_count == 0 || c.geometry == objects::kNoGeometry) continue;
            const FaceSoup source = objects_test::source_surface(scene, tree, id);
            const FaceSoup drawn = objects_test::drawn_surface(tree, c);
            const double measured_m = sampled_both_ways_m(source, drawn, 0.4);
            EXPECT_LE(measured_m, double(c.error_m) + 1e-9) << "seed " << seed << " cluster " << id;
            closest = std::max(closest, c.error_m > 0.0f ? measured_m / double(c.error_m) : 0.0);
            ++judged;
            reduced += drawn.faces.size() < source.faces.size();
        }
    }
    EXPECT_GT(judged, 30u);
    EXPECT_GT(reduced, judged / 2);
    EXPECT_GT(closest, 0.3);  // bounds are no excuse for being loose
    std::printf("%zu clusters, %zu of them reduced; largest measured share of a bound %.2f\n", judged,
                reduced, closest);
}

}  // namespace
