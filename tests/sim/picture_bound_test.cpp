// What is drawn of timed scenes beside everything: silhouettes and depths differ by no more than the error that is told.
#include <gtest/gtest.h>

#include <cstdio>

#include "data/scenes/scene_family.h"
#include "lod/base/rng.h"
#include "objects/clustering/cluster_build.h"
#include "tests/sim/two_pictures.h"

namespace {

using sim_test::PictureTally;
using sim_test::TwoPictures;

constexpr int kWidth_px = 320, kHeight_px = 180, kPictures = 24, kFactor = 3;

/// Around and within the scene, looking into it.
lod::View random_view(const objects::Cluster& root, lod::Rng& rng) {
    lod::View optics;
    optics.width_px = kWidth_px;
    optics.height_px = kHeight_px;
    const auto within = [&](double reach) {
        return glm::dvec3(root.centre) +
               reach * double(root.radius_m) *
                   glm::dvec3(rng.between(-1.0, 1.0), rng.between(-1.0, 1.0), rng.between(-0.5, 1.0));
    };
    return lod::look_at(within(rng.between(0.3, 5.0)), within(0.4), {0.0, 0.0, 1.0}, optics);
}

void expect_true_pictures(const data::FamilyOptions& family) {
    objects::BuildOptions options;
    options.threads = 2;
    objects::ClusterTree tree = objects::build_cluster_tree(data::generate_family(family), options);
    auto renderer = TwoPictures::make_renderer(tree, kFactor * kWidth_px, kFactor * kHeight_px);
    if (!renderer) GTEST_SKIP() << renderer.message();
    TwoPictures pictures(std::move(tree), std::move(*renderer));
    lod::Rng rng(family.seed + 100);
    PictureTally all;
    for (int i = 0; i < kPictures; ++i) {
        const lod::View view = random_view(pictures.tree().clusters[0], rng);
        const double time_s = rng.between(0.0, family.end_s), tolerance_px = rng.between(1.0, 6.0);
        const PictureTally tally = pictures.compare(view, time_s, tolerance_px, kFactor);
        EXPECT_EQ(tally.contradicting, 0u) << "picture " << i << " at " << time_s << " s";
        EXPECT_LE(tally.largest_bound_px, tolerance_px);
        all.add(tally);
    }
    std::printf("%lu pixels covered, %lu differ, %lu of them by something lost\n", all.covered, all.differing,
                all.lost);
    EXPECT_GT(all.covered, 450'000u);
    EXPECT_GT(all.differing, all.covered / 200) << "nothing was reduced";
    EXPECT_LT(all.lost, all.covered / 1000);
}

TEST(PictureBound, HighRiseThatIsBuiltAndLifted) {
    expect_true_pictures(
        {.family = data::SceneFamily::kHighRise, .seed = 1, .objects = 3000, .moving_share = 0.1});
}

TEST(PictureBound, HousesWithGapsThatComeAndGo) {
    expect_true_pictures({.family = data::SceneFamily::kGroup,
                          .seed = 2,
                          .objects = 3000,
                          .sparsity = 0.3,
                          .events_per_object = 3.0});
}

TEST(PictureBound, NoCoherenceAtAll) {
    expect_true_pictures(
        {.family = data::SceneFamily::kScattered, .seed = 3, .objects = 2000, .coherence = 0.0});
}

}  // namespace
