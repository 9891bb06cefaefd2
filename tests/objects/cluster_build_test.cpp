// Built trees against the scene they were built from: who is in them, when, and how far off.
#include "objects/clustering/cluster_build.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>

#include "data/scene_time.h"
#include "tests/objects/small_scenes.h"
#include "tests/objects/tree_surfaces.h"

namespace {

using objects::Cluster;
using objects::ClusterId;
using objects::ClusterTree;
using objects_test::build;
using objects_test::drawn_surface;
using objects_test::gather_leaves;
using objects_test::small_scene;
using objects_test::source_surface;

TEST(ClusterBuild, EveryObjectThatIsThereIsInExactlyOneLeaf) {
    for (uint32_t count : {1u, 2u, 17u, 200u}) {
        const data::TimedScene scene = small_scene({.objects = count, .moving_share = 0.3});
        const ClusterTree tree = build(scene);
        for (double time = 0.0; time <= scene.end_s; time += 50.0) {
            std::vector<uint32_t> leaves_of(count, 0);
            for (const Cluster& c : tree.clusters) {
                if (c.child_count == 0 && objects::visibility_at(tree, c.visibility, time) == 1.0)
                    ++leaves_of[c.object];
            }
            for (uint32_t i = 0; i < count; ++i)
                EXPECT_EQ(leaves_of[i], data::is_visible(scene, scene.objects[i], time) ? 1u : 0u);
        }
    }
}

TEST(ClusterBuild, LeavesStandWhereTheirObjectsDo) {
    const data::TimedScene scene = small_scene({.objects = 150, .seed = 2, .moving_share = 0.4});
    const ClusterTree tree = build(scene);
    size_t rests = 0;
    for (const Cluster& c : tree.clusters) {
        if (c.child_count > 0) continue;
        const data::TimedObject& object = scene.objects[c.object];
        EXPECT_EQ(c.error_m, 0.0f);
        EXPECT_EQ(tree.geometries[c.geometry].index_count, 3 * scene.meshes[object.mesh].triangles.size());
        const bool is_rest = c.motion_class != data::motion_class(scene, object);
        rests += is_rest;
        for (double time = 0.0; time <= scene.end_s; time += 3.7) {
            if (objects::visibility_at(tree, c.visibility, time) == 0.0) continue;
            const data::ObjectPose pose = data::pose_at(scene, object, time);
            const data::IndexRange keys = tree.motions[c.motion];
            if (keys.size() > 1) continue;
            EXPECT_EQ(tree.keys[keys.begin].position, pose.position);
            EXPECT_EQ(tree.keys[keys.begin].rotation, pose.rotation);
        }
    }
    EXPECT_GT(rests, 20u);
}

TEST(ClusterBuild, VisibilityIsTheWeightedMeanOfTheLeaves) {
    const data::TimedScene scene = small_scene({.objects = 250, .seed = 3});
    const ClusterTree tree = build(scene);
    for (ClusterId id = 0; id < tree.clusters.size(); ++id) {
        const Cluster& c = tree.clusters[id];
        std::vector<ClusterId> leaves;
        gather_leaves(tree, id, leaves);
        double total = 0.0;
        for (ClusterId leaf : leaves)
            total += tree.clusters[leaf].weight_m;
        EXPECT_NEAR(c.weight_m, total, 1e-9 * total);
        for (double time = 0.5; time <= scene.end_s; time += 31.0) {
            double there = 0.0;
            size_t count = 0;
            for (ClusterId leaf : leaves) {
                const bool is_there =
                    objects::visibility_at(tree, tree.clusters[leaf].visibility, time) == 1.0;
                there += is_there ? tree.clusters[leaf].weight_m : 0.0;
                count += is_there;
            }
            const double v = objects::visibility_at(tree, c.visibility, time);
            EXPECT_NEAR(v, there / total, 1.0 / 64.0 + 1e-9);  // the slack of long functions
            EXPECT_GE(std::min(v, 1.0 - v), std::min(there / total, 1.0 - there / total) - 1e-9);
            EXPECT_EQ(v == 0.0, count == 0);
            EXPECT_EQ(v == 1.0, count == leaves.size());
        }
    }
}

TEST(ClusterBuild, GammaIsTheIntegralOfTheDifference) {
    const data::TimedScene scene = small_scene({.objects = 200, .seed = 4});
    const ClusterTree tree = build(scene);
    for (const Cluster& c : tree.clusters) {
        double gamma = 0.0;
        for (uint32_t i = c.first_child; i < c.first_child + c.child_count; ++i) {
            const Cluster& child = tree.clusters[i];
            // Between any two instants at which either changes the difference is constant: sum rectangles.
            std::set<double> instants = {0.0, scene.end_s};
            for (uint32_t visibility : {c.visibility, child.visibility}) {
                const data::IndexRange steps = tree.visibilities[visibility];
                instants.insert(tree.step_time_s.begin() + steps.begin, tree.step_time_s.begin() + steps.end);
            }
            double integral = 0.0;
            for (auto next = std::next(instants.begin()); next != instants.end(); ++next) {
                const double from = *std::prev(next);
                integral += (*next - from) * std::abs(objects::visibility_at(tree, c.visibility, from) -
                                                      objects::visibility_at(tree, child.visibility, from));
            }
            gamma = std::max(gamma, double(child.gamma) + integral / scene.end_s);
        }
        EXPECT_NEAR(double(c.gamma), gamma, 1e-6);
    }
}

TEST(ClusterBuild, BoundsHoldEverythingBelow) {
    const data::TimedScene scene = small_scene({.objects = 220, .seed = 6});
    const ClusterTree tree = build(scene);
    for (ClusterId id = 0; id < tree.clusters.size(); ++id) {
        const Cluster& c = tree.clusters[id];
        if (c.motion_class == data::MotionClass::kDynamic && !tree.moves(id)) continue;  // next test
        if (id == objects::kRootCluster) continue;
        objects::FaceSoup all = source_surface(scene, tree, id);
        if (c.geometry != objects::kNoGeometry)
            objects::append_soup(drawn_surface(tree, c), glm::dmat3(1.0), glm::dvec3(0.0), all);
        for (const glm::dvec3& p : all.points) {
            EXPECT_LE(glm::length(p - glm::dvec3(c.centre)), double(c.radius_m) + 1e-9);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(p[axis], double(c.box_min[axis]) - 1e-9);
                EXPECT_LE(p[axis], double(c.box_max[axis]) + 1e-9);
            }
        }
    }
}

TEST(ClusterBuild, HoldersContainTheirMoversWhereverTheyGo) {
    const data::TimedScene scene = small_scene({.objects = 120, .seed = 7, .moving_share = 0.5});
    const ClusterTree tree = build(scene);
    size_t holders = 0;
    for (ClusterId id = 0; id < tree.clusters.size(); ++id) {
        const Cluster& c = tree.clusters[id];
        if (c.motion_class != data::MotionClass::kDynamic || c.geometry != objects::kNoGeometry) continue;
        ++holders;
        std::vector<ClusterId> leaves;
        gather_leaves(tree, id, leaves);
        for (ClusterId leaf : leaves) {
            const uint32_t i = tree.clusters[leaf].object;
            for (double time = 0.0; time <= scene.end_s; time += 50.0) {
                const data::ObjectPose pose = data::pose_at(scene, scene.objects[i], time);
                for (const glm::vec3& corner : scene.meshes[scene.objects[i].mesh].positions) {
                    const glm::dvec3 p = pose.rotation * glm::dvec3(corner) + pose.position;
                    EXPECT_LE(glm::length(p - glm::dvec3(c.centre)), double(c.radius_m) + 1e-9);
                }
            }
        }
    }
    EXPECT_GT(holders, 10u);
}

TEST(ClusterBuild, EqualGeometryOnce) {
    const data::TimedScene scene = small_scene({.objects = 200, .seed = 8});
    const ClusterTree tree = build(scene);
    std::set<uint32_t> of_leaves;
    for (const Cluster& c : tree.clusters) {
        if (c.child_count == 0) of_leaves.insert(c.geometry);
    }
    EXPECT_EQ(of_leaves.size(), 3u);  // two of the four meshes are equal
    std::set<std::string> contents;
    for (const objects::ClusterGeometry& g : tree.geometries) {
        std::string bytes(reinterpret_cast<const char*>(&tree.vertices[g.first_vertex]), 32 * g.vertex_count);
        bytes.append(reinterpret_cast<const char*>(&tree.indices[g.first_index]), 4 * g.index_count);
        EXPECT_TRUE(contents.insert(bytes).second);
    }
}

TEST(ClusterBuild, TheSameForAnyNumberOfThreads) {
    const data::TimedScene scene = small_scene({.objects = 400, .seed = 9});
    const ClusterTree one = build(scene, 1), three = build(scene, 3);
    const auto same = [](const auto& a, const auto& b) {
        return a.size() == b.size() &&
               (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
    };
    EXPECT_TRUE(same(one.clusters, three.clusters));
    EXPECT_TRUE(same(one.vertices, three.vertices));
    EXPECT_TRUE(same(one.indices, three.indices));
    EXPECT_TRUE(same(one.step_value, three.step_value));
}

TEST(ClusterBuild, MaterialsAndColoursSurvive) {
    const data::TimedScene scene = small_scene({.objects = 200, .seed = 10});
    const ClusterTree tree = build(scene);
    uint64_t glass = 0, mixed = 0;
    for (const Cluster& c : tree.clusters) {
        if (c.child_count < 2 || c.geometry == objects::kNoGeometry) continue;
        const objects::ClusterGeometry& g = tree.geometries[c.geometry];
        for (uint32_t i = 0; i < g.index_count; ++i) {
            const lod::Vertex& v = tree.vertices[g.first_vertex + tree.indices[g.first_index + i]];
            const bool is_glass = i >= g.index_count - g.glass_index_count;
            const lod::Material material = static_cast<lod::Material>(v.colour[3]);
            ASSERT_EQ(material == lod::Material::kGlass, is_glass);
            ASSERT_TRUE(is_glass || material == lod::Material::kPaint ||
                        material == lod::Material::kAllRound);
            const glm::ivec3 colour(v.colour[0], v.colour[1], v.colour[2]);
            if (is_glass) {
                ASSERT_EQ(colour, glm::ivec3(90, 120, 200));
            } else {  // between the two paints, (180, 90, 60) and (200, 200, 60)
                const double share = (colour.y * colour.y - 8100.0) / (40000.0 - 8100.0);
                ASSERT_TRUE(share >= 0.0 && share <= 1.0 && colour.z == 60) << colour.y;
                ASSERT_NEAR(colour.x * colour.x, 32400.0 + share * (40000.0 - 32400.0), 400.0);
                mixed += share > 0.0 && share < 1.0;
            }
            glass += is_glass;
        }
    }
    EXPECT_GT(glass, 0u);
    EXPECT_GT(mixed, 0u);
}

TEST(ClusterBuild, NastyScenes) {
    data::TimedScene empty;
    empty.end_s = 1.0;
    EXPECT_EQ(build(empty).clusters.size(), 1u);

    data::TimedScene scene;
    scene.end_s = 1e9;
    scene.meshes.push_back({});  // no triangles at all
    objects::FaceSoup nasty = objects_test::box({1, 1, 1}, {9, 9, 9, 255});
    nasty.points.emplace_back(0.1, 0.2, 0.3);
    const std::vector<std::array<uint32_t, 3>> bad = {{0, 0, 0}, {1, 1, 2}, {0, 2, 1},
                                                      {0, 2, 1}, {8, 8, 8}, {0, 1, 7}};
    nasty.faces.insert(nasty.faces.end(), bad.begin(), bad.end());
    nasty.colours.resize(nasty.faces.size(), {9, 9, 9, 255});
    scene.meshes.push_back(objects_test::mesh_of(nasty));
    scene.meshes.push_back(objects_test::mesh_of(objects_test::box({0, 0, 0}, {1, 2, 3, 255})));
    uint32_t number = 0;
    const auto add = [&](uint32_t mesh, std::vector<data::VisibilityStep> events, const glm::dvec3& at) {
        data::ObjectPlan plan;
        plan.mesh = mesh;
        plan.id = std::to_string(number++);
        plan.events = std::move(events);
        plan.keys = {{0.0, at, {1, 0, 0, 0}}};
        ASSERT_TRUE(static_cast<bool>(data::append_object(plan, scene)));
    };
    for (uint32_t mesh = 0; mesh < 3; ++mesh) {
        add(mesh, {}, {0, 0, 0});
        add(mesh, {{5.0, true}, {5.0, false}}, {1, 0, 0});    // never seen
        add(mesh, {{0.0, false}}, {1, 1, 0});                 // never there
        add(mesh, {{-7.0, true}}, {0, 1, 0});                 // before 0
        add(mesh, {{2e9, true}}, {0, 1, 1});                  // after T
        add(mesh, {{1e9, true}}, {0, 2, 1});                  // at T
        add(mesh, {{3.0, true}, {1e9, false}}, {0, 2, 2});    // till T
        add(mesh, {{3.0, true}, {8e8, false}}, {1e5, 0, 0});  // far away
        add(mesh, {{3.0, true}, {8e8, false}}, {1e5, 0, 0});  // twice at one place
    }
    const ClusterTree tree = build(scene);
    for (const Cluster& c : tree.clusters) {
        if (c.child_count > 0) continue;
        for (double time : {0.0, 3.0, 5.0, 8e8, 999999999.0, 1e9})
            EXPECT_EQ(objects::visibility_at(tree, c.visibility, time),
                      data::is_visible(scene, scene.objects[c.object], time))
                << c.object << " at " << time;
    }
}

}  // namespace
