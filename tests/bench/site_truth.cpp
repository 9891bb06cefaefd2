// Whether the bounds of the whole construction site are true: random clusters against the triangles of their objects, and
// random pictures against everything. Status 1 when one is not. CI asks the same of smaller scenes
// (tests/objects/cluster_error_test.cpp, tests/sim/picture_bound_test.cpp).
//
//     site_truth [CLUSTERS [PICTURES]]
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "data/scenes/construction_site.h"
#include "lod/base/rng.h"
#include "tests/objects/sampled_distance.h"
#include "tests/objects/tree_surfaces.h"
#include "tests/sim/two_pictures.h"

namespace {

constexpr int kWidth_px = 320, kHeight_px = 180, kFactor = 3;
constexpr size_t kMostFaces = 200'000;  ///< of what a cluster stands for, lest one takes minutes

/// Clusters of all sizes: as many of each level as there are draws for it.
int false_clusters(const data::TimedScene& scene, const objects::ClusterTree& tree, int count,
                   lod::Rng& rng) {
    std::vector<std::vector<objects::ClusterId>> levels(64);
    for (objects::ClusterId id = 0; id < tree.clusters.size(); ++id) {
        const objects::Cluster& c = tree.clusters[id];
        if (c.child_count > 0 && c.geometry != objects::kNoGeometry) levels[c.level].push_back(id);
    }
    std::erase_if(levels, [](const auto& level) { return level.empty(); });
    int judged = 0, skipped = 0, failed = 0;
    double largest = 0.0;
    while (judged < count) {
        const std::vector<objects::ClusterId>& level = levels[rng.below(levels.size())];
        const objects::ClusterId id = level[rng.below(level.size())];
        const objects::Cluster& c = tree.clusters[id];
        const objects::FaceSoup source = objects_test::source_surface(scene, tree, id, rng.unit());
        ++judged;
        if (source.faces.size() > kMostFaces) {
            ++skipped;
            continue;
        }
        const double measured_m = objects_test::sampled_both_ways_m(
            source, objects_test::drawn_surface(tree, c), std::max(0.3, 0.5 * double(c.error_m)));
        if (measured_m > double(c.error_m) + 1e-6) {
            std::printf("cluster %u of level %u: %.4f m measured, %.4f told\n", id, unsigned(c.level),
                        measured_m, double(c.error_m));
            ++failed;
        }
        if (c.error_m > 0.0f) largest = std::max(largest, measured_m / double(c.error_m));
    }
    std::printf(
        "%d clusters of %zu levels: %d beyond their error, %d too large to ask; largest measured share "
        "%.3f\n",
        judged, levels.size(), failed, skipped, largest);
    return failed;
}

uint64_t false_pixels(sim_test::TwoPictures& pictures, int count, lod::Rng& rng) {
    lod::View optics;
    optics.width_px = kWidth_px;
    optics.height_px = kHeight_px;
    sim_test::PictureTally all;
    for (int i = 0; i < count; ++i) {
        const auto around = [&](double reach_m, double low_m, double high_m) {
            return glm::dvec3(rng.between(-reach_m, reach_m), rng.between(-reach_m, reach_m),
                              rng.between(low_m, high_m));
        };
        const double reach_m = rng.between(80.0, 1500.0);
        const lod::View view =
            lod::look_at(around(reach_m, 2.0, 0.6 * reach_m), around(60.0, 0.0, 200.0), {0, 0, 1}, optics);
        const double time_s = rng.between(0.0, pictures.tree().end_s), tolerance_px = rng.between(1.0, 4.0);
        const sim_test::PictureTally tally = pictures.compare(view, time_s, tolerance_px, kFactor);
        if (tally.contradicting > 0)
            std::printf("picture %d at %.1f s, %.2f px: %lu pixels contradict\n", i, time_s,
                        tally.largest_bound_px, tally.contradicting);
        all.add(tally);
    }
    std::printf(
        "%d pictures: %lu pixels covered, %lu differ, %lu of them by something lost, %lu contradict\n", count,
        all.covered, all.differing, all.lost, all.contradicting);
    return all.contradicting;
}

}  // namespace

int main(int count, char** words) {
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    const int clusters = count > 1 ? std::atoi(words[1]) : 300,
              pictures = count > 2 ? std::atoi(words[2]) : 100;
    const data::TimedScene scene = data::generate_construction_site(0);
    objects::ClusterTree tree = objects_test::build(scene);
    lod::Rng rng(1);
    const int failed = false_clusters(scene, tree, clusters, rng);
    auto renderer = sim_test::TwoPictures::make_renderer(tree, kFactor * kWidth_px, kFactor * kHeight_px);
    if (!renderer) {
        std::fprintf(stderr, "%s\n", renderer.message().c_str());
        return 1;
    }
    sim_test::TwoPictures both(std::move(tree), std::move(*renderer));
    return failed > 0 || false_pixels(both, pictures, rng) > 0 ? 1 : 0;
}
