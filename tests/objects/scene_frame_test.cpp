// Where geometry lies in a built tree, beside the scene it was made from.
#include "objects/clustering/scene_frame.h"

#include <gtest/gtest.h>

#include "objects/clustering/cluster_build.h"
#include "objects/facing_ranges.h"
#include "objects/scene_view.h"
#include "tests/objects/small_scenes.h"

namespace {

constexpr uint32_t kAlone = 20, kTwins = 3;

/// Boxes no two alike, far from the scene's origin and turned at will; three of one kind; and one that moves.
data::TimedScene some_boxes() {
    lod::Rng rng(21);
    data::TimedScene scene;
    scene.end_s = 10.0;
    for (uint32_t i = 0; i < kAlone + kTwins + 1; ++i) {
        const bool is_twin = i >= kAlone && i < kAlone + kTwins;
        if (!is_twin || i == kAlone)
            scene.meshes.push_back(objects_test::mesh_of(
                objects_test::box({2.0 + 0.1 * i, 3.0, 5.0 + rng.unit()}, {200, 90, 60, 255})));
        data::ObjectPlan plan;
        plan.id = std::to_string(i);
        plan.mesh = static_cast<uint32_t>(scene.meshes.size() - 1);
        const glm::dquat turn =
            glm::angleAxis(rng.between(0.0, 6.0), glm::normalize(glm::dvec3(0.2, 0.1, 1.0)));
        const glm::dvec3 at(4000.0 + 20.0 * (i % 5), -7000.0 + 20.0 * (i / 5), 30.0);
        plan.keys = {{0.0, at, turn}};
        if (i == kAlone + kTwins) plan.keys.push_back({10.0, at + glm::dvec3(50, 0, 0), turn});
        CHECK(data::append_object(plan, scene));
    }
    return scene;
}

TEST(SceneFrame, WhatStandsAloneIsWhereItsObjectIs) {
    const data::TimedScene scene = some_boxes();
    const objects::ClusterTree tree = objects::build_cluster_tree(scene, {});
    uint32_t alone = 0, twins = 0;
    for (const objects::Cluster& leaf : tree.clusters) {
        if (leaf.child_count > 0) continue;
        const bool is_alone = leaf.object < kAlone;
        EXPECT_EQ(leaf.motion == objects::kSceneFrame, is_alone) << leaf.object;
        alone += is_alone;
        twins += leaf.object >= kAlone && leaf.object < kAlone + kTwins;
        const data::TimedObject& object = scene.objects[leaf.object];
        const data::ObjectPose is = objects::pose_of(tree, leaf, 4.0),
                               should = data::pose_at(scene, object, 4.0);
        const objects::ClusterGeometry& geometry = tree.geometries[leaf.geometry];
        for (uint32_t i = 0; i < geometry.vertex_count; ++i) {
            const lod::Vertex& vertex = tree.vertices[geometry.first_vertex + i];
            const glm::dvec3 at = is.rotation * lod::position_of(vertex) + is.position;
            const glm::dvec3 normal = is.rotation * glm::dvec3(lod::decode_normal(vertex.surface));
            double nearest_m = 1e9;
            const data::TimedMesh& mesh = scene.meshes[object.mesh];
            for (size_t k = 0; k < mesh.positions.size(); ++k) {
                const glm::dvec3 there = should.rotation * glm::dvec3(mesh.positions[k]) + should.position;
                const bool is_of_this_side =
                    glm::dot(normal, should.rotation * glm::dvec3(mesh.normals[k])) > 0.999;
                if (is_of_this_side) nearest_m = std::min(nearest_m, glm::distance(at, there));
            }
            EXPECT_LT(nearest_m, 1e-6) << leaf.object;
        }
    }
    EXPECT_EQ(alone, kAlone);
    EXPECT_EQ(twins, kTwins);
}

/// All faces of a box whose front side the eye is on, as planes tell.
TEST(SceneFrame, FacesThatLookAtTheEyeAreDrawn) {
    const objects::ClusterTree tree = objects::build_cluster_tree(some_boxes(), {});
    lod::Rng rng(22);
    size_t left_out = 0;
    std::vector<objects::IndexSpan> spans;
    for (const objects::Cluster& leaf : tree.clusters) {
        if (leaf.child_count > 0 || leaf.motion != objects::kSceneFrame) continue;
        const objects::ClusterGeometry& geometry = tree.geometries[leaf.geometry];
        for (int look = 0; look < 50; ++look) {
            const glm::dvec3 eye =
                glm::dvec3(leaf.centre) +
                glm::dvec3(rng.between(-90, 90), rng.between(-90, 90), rng.between(-90, 90));
            spans.clear();
            objects::visible_spans(tree, geometry, eye, 0.1, spans);
            for (uint32_t i = 0; i < geometry.index_count; i += 3) {
                const auto corner = [&](uint32_t k) {
                    return lod::position_of(
                        tree.vertices[geometry.first_vertex + tree.indices[geometry.first_index + i + k]]);
                };
                const glm::dvec3 a = corner(0), normal = glm::cross(corner(1) - a, corner(2) - a);
                const bool is_drawn =
                    std::any_of(spans.begin(), spans.end(), [&](const objects::IndexSpan& span) {
                        return i >= span.first && i < span.first + span.count;
                    });
                left_out += !is_drawn;
                EXPECT_TRUE(is_drawn || glm::dot(normal, eye - a) <= 0.0) << leaf.object;
            }
        }
    }
    EXPECT_GT(left_out, 2000u);
}

}  // namespace
