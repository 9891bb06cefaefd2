// How the build's work grows with the scene, by counts: no clock is asked, so nothing depends on the machine.
#include <gtest/gtest.h>

#include <cmath>

#include "data/scenes/scene_family.h"
#include "objects/clustering/cluster_build.h"
#include "objects/tree_file.h"

namespace {

using data::SceneFamily;

struct Built {
    std::vector<unsigned char> file;
    objects::BuildCounts counts;
};

Built build_family(const data::FamilyOptions& family, const objects::BuildOptions& options) {
    const data::TimedScene scene = data::generate_family(family);
    Built built;
    const objects::ClusterTree tree = objects::build_cluster_tree(
        scene, options, [&built](const objects::BuildState& state) { built.counts = state.counts; });
    built.file = objects::encode_tree(tree);
    return built;
}

/// The most of each count that an object may cause for each doubling of their number.
struct Ceilings {
    double nodes = 0.0, steps = 0.0, faces = 0.0;
};

void expect_n_log_n(SceneFamily family, const objects::BuildOptions& options, const Ceilings& most) {
    for (const uint32_t objects : {1000u, 4000u, 16000u}) {
        SCOPED_TRACE(objects);
        const objects::BuildCounts counts =
            build_family({.family = family, .objects = objects, .triangles = 12}, options).counts;
        const double n_log_n = objects * std::log2(objects);
        EXPECT_LE(static_cast<double>(counts.nodes), most.nodes * n_log_n);
        EXPECT_LE(static_cast<double>(counts.steps), most.steps * n_log_n);
        EXPECT_LE(static_cast<double>(counts.faces), most.faces * n_log_n);
        EXPECT_GT(counts.faces, 12u * objects / 2);
    }
}

/// Neighbours in space are neighbours in time. Counted: 0.28 nodes, 6.2 steps, 3.07 faces at the most: sources that have spent
/// a quarter of a level's error are some levels down.
TEST(ClusterScaling, WorkOnATowerIsNLogN) {
    expect_n_log_n(SceneFamily::kHighRise, {.threads = 2}, {.nodes = 0.35, .steps = 7.0, .faces = 3.4});
}

/// In no order at all, which is the hardest for a tree over place and time; nothing is reduced here. One level a doubling,
/// none for single objects. Counted: 0.91 nodes, 6.6 steps, 4.0 faces at the most.
TEST(ClusterScaling, WorkWithoutOrderIsNLogN) {
    expect_n_log_n(SceneFamily::kScattered,
                   {.fine_doublings = 0, .levels_per_doubling = 1, .error_share = 0.0, .threads = 2},
                   {.nodes = 1.1, .steps = 7.5, .faces = 4.5});
}

/// The same with levels half-way and for single objects. Counted: 6.0 faces at the most.
TEST(ClusterScaling, WorkWithoutOrderOnMoreLevelsIsNLogN) {
    expect_n_log_n(SceneFamily::kScattered, {.error_share = 0.0, .threads = 2},
                   {.nodes = 1.1, .steps = 7.5, .faces = 6.8});
}

/// An object of a large scene costs what one of a small scene does: levels begin at the objects' size, not at the scene's.
TEST(ClusterScaling, FacesOfAnObjectDoNotDependOnTheScene) {
    const auto faces_each = [](uint32_t objects) {
        const Built built = build_family({.objects = objects, .triangles = 60}, {.threads = 2});
        return static_cast<double>(built.counts.faces) / objects;
    };
    const double one = faces_each(1100);
    EXPECT_NEAR(faces_each(1500), one, 0.15 * one);
    EXPECT_NEAR(faces_each(4500), one, 0.15 * one);
}

TEST(ClusterScaling, SourcesThatMayBeOffByMoreCostLess) {
    const auto faces = [](double spent_share) {
        return build_family({.objects = 1000, .triangles = 60}, {.spent_share = spent_share, .threads = 2})
            .counts.faces;
    };
    EXPECT_LT(faces(0.25), faces(0.06) / 2);
}

TEST(ClusterScaling, TheSameBytesAndCountsForAnyNumberOfThreads) {
    const data::FamilyOptions family{.objects = 5000, .triangles = 12};
    const Built one = build_family(family, {.threads = 1}), two = build_family(family, {.threads = 2});
    EXPECT_EQ(one.file, two.file);
    EXPECT_EQ(one.counts.nodes, two.counts.nodes);
    EXPECT_EQ(one.counts.steps, two.counts.steps);
    EXPECT_EQ(one.counts.faces, two.counts.faces);
}

}  // namespace
