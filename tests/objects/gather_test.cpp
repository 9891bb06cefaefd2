// Faces that stand for several things: near enough by dense samples, each thing in exactly one of them, and as few as can be told by
// hand.
#include "objects/reduction/gather.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "objects/reduction/fat_faces.h"
#include "objects/reduction/reduce.h"
#include "objects/reduction/stand_in.h"
#include "tests/objects/prisms.h"
#include "tests/objects/sampled_distance.h"

namespace {

using objects::FaceLoad;
using objects::FaceSoup;
using objects::Gathered;
using objects_test::prism;

/// Towers on a lattice, each with the faces that stand for it, and what is made of these.
struct Town {
    FaceSoup all;
    std::vector<FaceLoad> loads;
    std::vector<Gathered> gathered;

    void add(const FaceSoup& tower, double limit_m) {
        const FaceSoup faces = objects::stand_in(tower, limit_m).to_gather;
        for (FaceLoad& load : objects::share_out(tower, faces, limit_m))
            loads.push_back(std::move(load));
        objects::append_soup(tower, glm::dmat3(1.0), glm::dvec3(0.0), all);
    }
    void settle(double limit_m) {
        gathered = objects::gather(all, lod::TriangleTree(all.view()), limit_m, loads);
    }
    FaceSoup soup() const {
        FaceSoup faces;
        for (const Gathered& group : gathered) {
            const uint32_t first = static_cast<uint32_t>(faces.points.size());
            faces.points.insert(faces.points.end(), {group.face.a, group.face.b, group.face.c});
            faces.faces.push_back({first, first + 1, first + 2});
            faces.colours.push_back(group.colour);
        }
        return faces;
    }
};

Town lattice(int side, double cell_m, double limit_m) {
    Town town;
    lod::Rng rng(5);
    for (int i = 0; i < side * side; ++i)
        town.add(prism(12, rng.between(2.0, 4.0), rng.between(4.0, 12.0),
                       {cell_m * (i % side), cell_m * (i / side), 0.0}),
                 limit_m);
    town.settle(limit_m);
    return town;
}

TEST(Gather, IsAsNearAsAskedBothWays) {
    for (const double limit_m : {4.5, 6.0, 9.0}) {
        const Town town = lattice(6, 12.66, limit_m);
        EXPECT_LE(objects_test::sampled_both_ways_m(town.all, town.soup(), 0.2), limit_m) << limit_m;
    }
}

TEST(Gather, TheCoarserTheFewer) {
    const auto faces = [](double limit_m) { return lattice(8, 12.66, limit_m).gathered.size(); };
    EXPECT_LT(faces(5.5), 32u);  // of 64 towers
    EXPECT_LT(faces(9.0), 14u);
    EXPECT_LT(faces(40.0), 3u);
}

/// What is between two is empty, and half-way farther from either than the limit.
TEST(Gather, NothingIsGatheredAcrossWideGaps) {
    const double limit_m = 4.5;
    const Town town = lattice(4, 2.0 * (4.0 + limit_m) + 1.0, limit_m);
    EXPECT_EQ(town.gathered.size(), town.loads.size());
}

TEST(Gather, EveryLoadIsInOneFace) {
    const Town town = lattice(6, 12.66, 5.0);
    std::vector<uint32_t> all;
    for (const Gathered& group : town.gathered)
        all.insert(all.end(), group.loads.begin(), group.loads.end());
    std::sort(all.begin(), all.end());
    ASSERT_EQ(all.size(), town.loads.size());
    for (uint32_t i = 0; i < all.size(); ++i)
        EXPECT_EQ(all[i], i);
}

/// Light adds up, not numbers: 100 and 200, equally large, are sqrt((100^2 + 200^2) / 2).
TEST(Gather, ColoursAreMeansOfLightAndGlassStaysByItself) {
    const double limit_m = 9.0;
    Town town;
    town.add(prism(12, 3.0, 6.0, {0, 0, 0}, {100, 0, 50, 255}), limit_m);
    town.add(prism(12, 3.0, 6.0, {8, 0, 0}, {200, 0, 50, 255}), limit_m);
    town.settle(limit_m);
    ASSERT_EQ(town.gathered.size(), 1u);
    EXPECT_EQ(glm::u8vec3(town.gathered[0].colour), glm::u8vec3(158, 0, 50));
    EXPECT_TRUE(objects::is_all_round(town.gathered[0].colour));
    town.add(prism(12, 3.0, 6.0, {4, 7, 0}, {200, 0, 50, objects::kGlass}), limit_m);
    town.settle(limit_m);
    ASSERT_EQ(town.gathered.size(), 2u);
    EXPECT_TRUE(objects::is_glass(town.gathered[1].colour));
}

/// One face would not be seen from its edge.
TEST(Gather, AMastOfSectionsIsNone) {
    const double limit_m = 2.0;
    Town town;
    for (int section = 0; section < 10; ++section)
        town.add(prism(4, 0.8, 5.9, {0.0, 0.0, 6.0 * section}), limit_m);
    town.settle(limit_m);
    EXPECT_EQ(town.gathered.size(), town.loads.size());
}

/// The city that is drawn beside other programs (tests/bench), a corner of it.
FaceSoup corner_of_the_city(uint32_t side) {
    const data::TimedScene scene = bench::prism_city(side * side, side);
    FaceSoup all;
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const data::TimedMesh& mesh = scene.meshes[i];
        FaceSoup tower;
        for (const glm::vec3& position : mesh.positions)
            tower.points.push_back(glm::dvec3(position) + scene.keys[i].position);
        tower.faces = mesh.triangles;
        for (const auto& face : tower.faces)
            tower.colours.push_back(mesh.colours[face[0]]);
        objects::append_soup(tower, glm::dmat3(1.0), glm::dvec3(0.0), all);
    }
    return all;
}

/// All of it, as a build does it. Ceilings are a twentieth above what was counted; without gathering it is one a tower and
/// more however far away.
TEST(Gather, FacesATowerOfTheCity) {
    const FaceSoup city = objects::with_fat_faces(corner_of_the_city(16));
    const std::pair<double, double> within_m_at_most[] = {
        {2.6, 2.62}, {3.7, 1.19}, {5.2, 0.44}, {8.8, 0.193}, {25.0, 0.013}};
    for (const auto& [limit_m, most] : within_m_at_most) {
        const FaceSoup reduced = objects::reduce_within(city, limit_m);
        const double faces = static_cast<double>(reduced.faces.size()) / 256.0;
        std::printf("within %.1f m: %.3f faces a tower\n", limit_m, faces);
        EXPECT_LT(faces, most);
        EXPECT_LE(objects_test::sampled_both_ways_m(city, reduced, 0.5), limit_m);
    }
}

}  // namespace
