// What is told of gliding vertices beside samples of the surface with them and without.
#include "lod/progressive/glide_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lod/base/rng.h"
#include "tests/lod/allocations.h"
#include "tests/lod/mesh_distance.h"
#include "tests/lod/plain_hierarchy.h"

namespace {

using lod::NodeId;

/// A cut of a hierarchy, some of whose vertices are not at their places.
struct Sliding {
    explicit Sliding(const lod_test::PlainMesh& mesh)
        : progressive(lod::make_progressive_mesh(lod_test::make_plain_history(mesh).hierarchy)),
          cut(progressive),
          glides(progressive.hierarchy.node_count(), 1.0) {}

    /// Splits until `count` nodes are active or no more split is legal without another.
    void refine(lod::Rng& rng, uint32_t splits) {
        for (uint32_t i = 0; i < 40 * splits; ++i) {
            const auto node = static_cast<NodeId>(rng.below(progressive.hierarchy.node_count()));
            if (progressive.is_leaf(node) || !cut.is_active(node)) continue;
            if (cut.split_blocker(node) == lod::kNoNode) cut.vsplit(node);
        }
    }
    bool may_glide(NodeId node) const {
        return cut.is_active(node) && progressive.hierarchy.parent[node] != lod::kNoNode;
    }
    glm::vec3 place(NodeId node) const { return progressive.hierarchy.position[node]; }

    /// Pixels between the surface with glides and the one without, both ways.
    double found_px(const lod::View& view, lod::Rng& rng) const {
        const lod_test::Soup still = lod_test::drawn(cut);
        const lod_test::Soup moved =
            lod_test::drawn(cut, [&](NodeId node) { return glides.displacement_m(node); });
        const lod::ViewMetric metric = lod::metric_of(view);
        return std::max(
            lod_test::farthest_px(lod_test::samples_of(still, rng), lod_test::CellGrid(moved), metric),
            lod_test::farthest_px(lod_test::samples_of(moved, rng), lod_test::CellGrid(still), metric));
    }
    double told_px(const lod::View& view) {
        const lod::AnchoredEye eye(view, glm::dvec3(0.0));
        return error.measure_px(cut, glides, {&eye, 1});
    }

    lod::ProgressiveMesh progressive;
    lod::MeshCut cut;
    lod::NodeGlides glides;
    lod::GlideError error;
};

lod::View view_at(const glm::dvec3& target, double away_m, double fov_y_rad) {
    lod::View optics;
    optics.width_px = 1280;
    optics.height_px = 720;
    optics.near_m = 0.02;
    optics.fov_y_rad = fov_y_rad;
    return lod::look_at(target + glm::normalize(glm::dvec3(0.2, -0.5, 1.0)) * away_m, target, {0.0, 0.0, 1.0},
                        optics);
}

/// Vertices anywhere between the places of their own and their neighbours', and off the surface.
TEST(GlideError, CoversAnyGlides) {
    lod::Rng rng(3);
    double share = 0.0;
    for (int round = 0; round < 60; ++round) {
        Sliding sliding(round % 2 == 0 ? lod_test::bumpy_sheet(14, 5) : lod_test::bumpy_ring(20, 12, 6));
        sliding.refine(rng, static_cast<uint32_t>(rng.below(150)));
        const uint64_t one_in = 1 + rng.below(12);
        const double off = round % 3 == 0 ? 0.02 : 0.0;
        for (NodeId node = 0; node < sliding.progressive.hierarchy.node_count(); ++node) {
            if (!sliding.may_glide(node) || rng.below(one_in) != 0) continue;
            const NodeId parent = sliding.progressive.hierarchy.parent[node];
            const glm::vec3 along = (sliding.place(parent) - sliding.place(node)) * float(rng.unit());
            sliding.glides.come(node, along + glm::vec3(0.0f, 0.0f, float(off * rng.unit())), 0.0);
        }
        const lod::View view = view_at({rng.between(0.0, 1.0), rng.between(0.0, 1.0), 0.0},
                                       rng.between(1.0, 6.0), rng.between(0.02, 1.2));
        const double told_px = sliding.told_px(view), found_px = sliding.found_px(view, rng);
        ASSERT_LE(found_px, told_px + 1e-9) << "round " << round;
        if (told_px > 0.0) share = std::max(share, found_px / told_px);
    }
    EXPECT_GT(share, 0.3);
}

/// Two ends of an edge, one after the other: the second moves what the first has left.
TEST(GlideError, NeighboursAddUp) {
    lod_test::PlainMesh rough = lod_test::bumpy_sheet(6, 5);
    lod::Rng rng(11);
    for (glm::vec3& position : rough.positions)
        position.z += float(rng.between(-0.2, 0.2));
    Sliding sliding(rough);
    sliding.refine(rng, 60);
    const lod::View view = view_at({0.4, 0.4, 0.0}, 4.0, 0.4);
    double share = 0.0;
    for (int round = 0; round < 8; ++round) {
        for (uint32_t triangle = 0; triangle < sliding.progressive.triangle_count(); ++triangle) {
            if (!sliding.cut.is_drawn(triangle)) continue;
            const auto corners = sliding.cut.corners(triangle);
            if (!sliding.may_glide(corners[0]) || !sliding.may_glide(corners[1])) continue;
            const glm::vec3 along = sliding.place(corners[2]) - sliding.place(corners[0]);
            for (NodeId node : {corners[0], corners[1]})
                sliding.glides.come(node, along * float(rng.between(-0.3, 0.7)), 0.0);
            const double found_px = sliding.found_px(view, rng), told_px = sliding.told_px(view);
            EXPECT_LE(found_px, told_px) << "triangle " << triangle;
            share = std::max(share, found_px / told_px);
            for (NodeId node : {corners[0], corners[1]})
                sliding.glides.drop(node);
        }
    }
    EXPECT_GT(share, 0.5);
    RecordProperty("largest_share", std::to_string(share));
}

/// All inner vertices of a plane at once, each towards a neighbour: they take one another's place on it.
TEST(GlideError, WhatSlidesInAPlaneIsNotOff) {
    lod_test::PlainMesh plane = lod_test::bumpy_sheet(12, 1);
    for (glm::vec3& position : plane.positions)
        position.z = 0.0f;
    Sliding sliding(plane);
    lod::Rng rng(5);
    sliding.refine(rng, 100);
    double farthest_m = 0.0;
    for (NodeId node = 0; node < sliding.progressive.hierarchy.node_count(); ++node) {
        const glm::vec3 place = sliding.place(node);
        const bool is_inside = std::min(place.x, place.y) > 0.05f && std::max(place.x, place.y) < 0.9f;
        if (!sliding.may_glide(node) || !is_inside || rng.below(4) != 0) continue;
        const glm::vec3 way(0.01f * float(rng.unit()), 0.01f * float(rng.unit()), 0.0f);
        sliding.glides.come(node, way, 0.0);
        farthest_m = std::max(farthest_m, double(glm::length(way)));
    }
    const lod::View view = view_at({0.5, 0.5, 0.0}, 1.0, 1.0);
    const double way_px = farthest_m * lod::metric_of(view).lambda_px;
    EXPECT_GT(way_px, 5.0);
    EXPECT_LE(sliding.told_px(view), 0.2);
}

/// A narrow view of a large triangle, one corner of which is far beside the picture.
TEST(GlideError, AVertexBesideThePictureMovesWhatIsInIt) {
    Sliding sliding(lod_test::bumpy_sheet(14, 5));
    lod::Rng rng(7);
    sliding.refine(rng, 60);
    int seen = 0;
    for (uint32_t triangle = 0; triangle < sliding.progressive.triangle_count(); ++triangle) {
        if (!sliding.cut.is_drawn(triangle)) continue;
        const auto corners = sliding.cut.corners(triangle);
        if (!sliding.may_glide(corners[0])) continue;
        sliding.glides.come(corners[0], {0.0f, 0.0f, 0.1f}, 0.0);
        glm::dvec3 middle(0.0);
        for (NodeId corner : corners)
            middle += glm::dvec3(sliding.place(corner) + sliding.glides.displacement_m(corner)) / 3.0;
        const lod::View view = view_at(middle, 3.0, 0.01);
        const lod_test::Soup still = lod_test::drawn(sliding.cut);
        const double found_px =
            lod_test::farthest_px({middle}, lod_test::CellGrid(still), lod::metric_of(view));
        EXPECT_LE(found_px, sliding.told_px(view)) << "triangle " << triangle;
        seen += found_px > 10.0;
        sliding.glides.drop(corners[0]);
    }
    EXPECT_GT(seen, 10);
}

TEST(GlideError, AllocatesNothingOnceWarm) {
    Sliding sliding(lod_test::bumpy_sheet(14, 5));
    lod::Rng rng(9);
    sliding.refine(rng, 100);
    for (NodeId node = 0; node < sliding.progressive.hierarchy.node_count(); ++node) {
        if (sliding.may_glide(node)) sliding.glides.come(node, {0.0f, 0.0f, 0.05f}, 0.0);
    }
    const lod::View view = view_at({0.5, 0.5, 0.0}, 2.0, 1.0);
    const double told_px = sliding.told_px(view);
    const uint64_t before = lod_test::allocation_count();
    EXPECT_EQ(sliding.told_px(view), told_px);
    EXPECT_EQ(lod_test::allocation_count(), before);
}

}  // namespace
