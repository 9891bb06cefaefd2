// What is not submitted because it looks away: asked by rays, which know nothing of cones and offsets.
#include "objects/facing_ranges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <set>

#include "lod/base/rng.h"
#include "objects/clustering/geometry_pool.h"
#include "tests/objects/small_scenes.h"

namespace {

using objects::ClusterTree;
using objects::FaceSoup;

/// A cluster tree of one geometry.
ClusterTree tree_of(const FaceSoup& soup) {
    objects::GeometryPool pool;
    pool.add(objects::draw_soup(soup));
    ClusterTree tree;
    pool.move_to(tree);
    return tree;
}

lod::Triangle triangle_at(const ClusterTree& tree, uint32_t index) {
    const auto at = [&](uint32_t i) { return lod::position_of(tree.vertices[tree.indices[i]]); };
    return {at(index), at(index + 1), at(index + 2)};
}

/// How far along a ray a triangle is met. Source: Moeller, Trumbore (1997).
std::optional<double> hit(const glm::dvec3& eye, const glm::dvec3& ray, const lod::Triangle& t) {
    const glm::dvec3 ab = t.b - t.a, ac = t.c - t.a, p = glm::cross(ray, ac);
    const double det = glm::dot(ab, p);
    if (std::abs(det) < 1e-12) return {};
    const glm::dvec3 from = eye - t.a, q = glm::cross(from, ab);
    const double u = glm::dot(from, p) / det, v = glm::dot(ray, q) / det, at = glm::dot(ac, q) / det;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || at <= 0.0) return {};
    return at;
}

/// First index of the triangle that a ray meets first.
std::optional<uint32_t> first_met(const ClusterTree& tree, const glm::dvec3& eye, const glm::dvec3& ray) {
    std::optional<uint32_t> met;
    double nearest = 1e30;
    for (uint32_t i = 0; i < tree.indices.size(); i += 3) {
        const std::optional<double> at = hit(eye, ray, triangle_at(tree, i));
        if (!at || *at >= nearest) continue;
        nearest = *at;
        met = i;
    }
    return met;
}

bool is_drawn(const std::vector<objects::IndexSpan>& spans, uint32_t index) {
    for (const objects::IndexSpan& span : spans) {
        if (index >= span.first && index < span.first + span.count) return true;
    }
    return false;
}

std::vector<objects::IndexSpan> spans_for(const ClusterTree& tree, const glm::dvec3& eye) {
    std::vector<objects::IndexSpan> spans;
    objects::visible_spans(tree, tree.geometries[0], eye, 0.5, spans);
    return spans;
}

/// Turned boxes, an open sheet, a box inside out and a dented solid.
FaceSoup some_solids(lod::Rng& rng, bool has_open_ones) {
    FaceSoup soup;
    for (int i = 0; i < 12; ++i) {
        FaceSoup box = objects_test::box(glm::dvec3(rng.between(1, 4), rng.between(1, 4), rng.between(1, 9)),
                                         {90, 90, 90, 255});
        if (has_open_ones && i == 3) box.faces.resize(10), box.colours.resize(10);
        if (has_open_ones && i == 5) {
            for (auto& face : box.faces)
                std::swap(face[0], face[1]);
        }
        if (has_open_ones && i == 7) box.points[0] = glm::dvec3(0.1, 0.1, 0.4);
        const double turn = rng.between(0.0, 6.28);
        const glm::dmat3 rotation(glm::dvec3(std::cos(turn), std::sin(turn), 0.0),
                                  glm::dvec3(-std::sin(turn), std::cos(turn), 0.0), glm::dvec3(0, 0, 1));
        objects::append_soup(box, rotation, {rng.between(-20, 20), rng.between(-20, 20), 0.0}, soup);
    }
    return soup;
}

TEST(Facing, WhatARayMeetsFirstIsDrawn) {
    lod::Rng rng(7);
    size_t met = 0, left_out = 0, total = 0;
    for (int round = 0; round < 60; ++round) {
        const ClusterTree tree = tree_of(some_solids(rng, round % 2 == 1));
        const double far = round % 3 == 0 ? 45.0 : 300.0;
        const glm::dvec3 eye(far * rng.between(-1, 1), far * rng.between(-1, 1),
                             rng.between(-20.0, 0.5 * far));
        const std::vector<objects::IndexSpan> spans = spans_for(tree, eye);
        for (uint32_t i = 0; i < tree.indices.size(); i += 3)
            left_out += !is_drawn(spans, i);
        total += tree.indices.size() / 3;
        for (int i = 0; i < 300; ++i) {
            const glm::dvec3 aim(rng.between(-22, 22), rng.between(-22, 22), rng.between(0.0, 9.0));
            const std::optional<uint32_t> first = first_met(tree, eye, aim - eye);
            if (!first) continue;
            ++met;
            EXPECT_TRUE(is_drawn(spans, *first)) << "round " << round;
        }
    }
    EXPECT_GT(met, 2000u);
    EXPECT_GT(left_out * 4, total);  // a quarter at least
}

TEST(Facing, OnlyClosedConvexSolidsAreLeftOut) {
    FaceSoup sheet;
    sheet.points = {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}};
    for (int i = 0; i < 6; ++i) {
        sheet.faces.push_back({0, 1, 2});
        sheet.faces.push_back({0, 2, 3});
    }
    sheet.colours.resize(sheet.faces.size(), {9, 9, 9, 255});
    EXPECT_TRUE(tree_of(sheet).facings.empty());
    FaceSoup box = objects_test::box({4, 4, 9}, {9, 9, 9, 255});
    EXPECT_FALSE(tree_of(box).facings.empty());
    for (auto& face : box.faces)
        std::swap(face[0], face[1]);
    EXPECT_TRUE(tree_of(box).facings.empty()) << "inside out";
}

TEST(Facing, NearByEverythingIsDrawn) {
    const ClusterTree tree = tree_of(objects_test::box({4, 4, 9}, {9, 9, 9, 255}));
    const glm::dvec3 middle(tree.geometries[0].centre);
    uint32_t near = 0, far = 0;
    for (const objects::IndexSpan& span : spans_for(tree, middle))
        near += span.count;
    for (const objects::IndexSpan& span : spans_for(tree, middle + glm::dvec3(60.0, 1.0, 2.0)))
        far += span.count;
    EXPECT_EQ(near, tree.geometries[0].index_count);
    EXPECT_LE(far, 18u);  // three sides of six
}

}  // namespace
