// What solids hide is left out of the picture, and the picture is the same to the bit.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "lod/base/rng.h"
#include "lod/scheduler.h"
#include "objects/cluster_front.h"
#include "objects/clustering/cluster_build.h"
#include "render/renderer.h"
#include "tests/bench/prism_city.h"

namespace {

constexpr int kColumns = 24;

/// The middle of a front's picture-making: one frame, to its end.
struct Artist {
    Artist(objects::ClusterTree tree, objects::Hiding hiding) : front(std::move(tree), {}) {
        front.set_hiding(hiding, 2);
    }

    void adapt(const lod::View& view, double time_s, double tolerance_px) {
        lod::Front* const fronts[] = {&front};
        lod::Budget budget;
        budget.tolerance_px = tolerance_px;
        front.set_coarsen_ratio(1.0);  // so that the cut follows from the view alone
        front.begin_frame({&view, 1}, time_s);
        lod::schedule(fronts, budget, lod::operation_limit(UINT64_MAX));
    }
    void draw(const lod::View& view, render::Renderer& renderer) {
        list.clear();
        front.emit(view, list);
        renderer.draw(view, list, render::vacuum());
    }

    objects::ClusterFront front;
    lod::DrawList list;
};

render::Renderer make_renderer(const objects::ClusterFront& front, const lod::View& view) {
    render::RendererOptions options;
    options.width_px = view.width_px;
    options.height_px = view.height_px;
    const lod::PoolRegion need = front.pool_need();
    options.pool = {need.vertex_capacity, need.index_capacity, 4 * front.tree().object_count + 64};
    auto renderer = render::Renderer::create(options);
    EXPECT_TRUE(renderer) << renderer.message();
    return std::move(*renderer);
}

/// What fronts drew over some frames.
struct Tally {
    uint64_t triangles = 0;          ///< nothing hidden
    uint64_t drawn_triangles = 0;    ///< without hidden clusters
    uint64_t showing_triangles = 0;  ///< without hidden triangles
    size_t frames_that_differ = 0;
};

struct Moment {
    lod::View view;
    double time_s = 0.0;
};

/// Draws each moment with everything and without what is hidden, cluster by cluster and triangle by triangle.
Tally compare(const objects::ClusterTree& tree, const std::vector<Moment>& moments, double tolerance_px) {
    using objects::Hiding;
    Artist all(tree, Hiding::kNothing), some(tree, Hiding::kClusters), few(tree, Hiding::kTriangles);
    render::Renderer canvas = make_renderer(few.front, moments[0].view);
    Tally tally;
    for (size_t i = 0; i < moments.size(); ++i) {
        SCOPED_TRACE(i);
        const auto& [view, time_s] = moments[i];
        std::vector<uint8_t> everything;
        for (Artist* artist : {&all, &some, &few}) {
            artist->adapt(view, time_s, tolerance_px);
            artist->front.place(artist->front.pool_need());  // another one has written the pool
            artist->draw(view, canvas);
            const std::vector<uint8_t> picture = canvas.read_colour().rgba;
            if (artist == &all) everything = picture;
            tally.frames_that_differ += picture != everything;
        }
        EXPECT_EQ(some.front.validate(), "");
        EXPECT_LE(some.front.error_px(), tolerance_px);
        if (i == 0) continue;  // nothing has been drawn that could hide anything
        tally.triangles += all.front.emitted_triangles();
        tally.drawn_triangles += some.front.emitted_triangles();
        tally.showing_triangles += few.front.emitted_triangles();
    }
    std::printf("%lu triangles, %lu of them not in hidden clusters, %lu may show\n", tally.triangles,
                tally.drawn_triangles, tally.showing_triangles);
    return tally;
}

lod::View optics() {
    lod::View view;
    view.width_px = 320;
    view.height_px = 180;
    view.near_m = 0.5;
    view.fov_y_rad = 0.8;
    return view;
}

TEST(HiddenClusters, ADrivePastHousesLooksTheSameAndDrawsAFraction) {
    const objects::ClusterTree tree =
        objects::build_cluster_tree(bench::prism_city(kColumns * kColumns, kColumns), {.threads = 2});
    std::vector<Moment> moments;
    for (int frame = 0; frame < 120; ++frame) {
        const double height_m = frame % 40 == 39 ? 22.0 : 2.0;
        const glm::dvec3 eye(30.0 + 1.5 * frame, 12.0 * bench::kCityCell_m, height_m);
        const glm::dvec3 ahead(100.0, 40.0 * std::sin(0.05 * frame), 0.0);
        moments.push_back({lod::look_at(eye, eye + ahead, {0.0, 0.0, 1.0}, optics()), 0.0});
    }
    for (const double tolerance_px : {2.0, 12.0}) {
        const Tally tally = compare(tree, moments, tolerance_px);
        EXPECT_EQ(tally.frames_that_differ, 0u);
        EXPECT_LT(tally.drawn_triangles, tolerance_px > 2.0 ? tally.triangles : tally.triangles / 2);
        EXPECT_LT(tally.showing_triangles, tally.drawn_triangles / 2);
    }
}

/// From jump to jump what stood far away and coarse is near and refined: what it seemed to hide must come to light.
TEST(HiddenClusters, JumpsThroughACityShowAllThatIsThere) {
    const objects::ClusterTree tree =
        objects::build_cluster_tree(bench::prism_city(kColumns * kColumns, kColumns), {.threads = 2});
    lod::Rng rng(3);
    std::vector<Moment> moments;
    for (int frame = 0; frame < 150; ++frame) {
        const double streets = kColumns * bench::kCityCell_m;
        const glm::dvec3 eye(rng.between(0.0, streets), bench::kCityCell_m * double(rng.below(kColumns)),
                             rng.between(2.0, 40.0));
        const glm::dvec3 target(rng.between(0.0, streets), rng.between(0.0, streets), 5.0);
        moments.push_back({lod::look_at(eye, target, {0.0, 0.0, 1.0}, optics()), 0.0});
    }
    EXPECT_EQ(compare(tree, moments, 2.0).frames_that_differ, 0u);
}

/// Every second wall of every third house is a pane: it hides nothing, and lies over what it does not hide. From above little
/// is hidden, so triangles are asked in strips only; then the eye comes down.
TEST(HiddenClusters, PanesShowWhatIsBehindThemFromAboveAndBelow) {
    data::TimedScene scene = bench::prism_city(kColumns * kColumns, kColumns);
    size_t panes = 0;
    for (size_t i = 0; i < scene.meshes.size(); i += 3) {
        data::TimedMesh& mesh = scene.meshes[i];
        for (size_t triangle = 0; triangle + 3 < mesh.triangles.size() / 2; triangle += 4) {
            for (size_t half = 0; half < 2; ++half) {
                for (uint32_t corner : mesh.triangles[triangle + half])
                    mesh.colours[corner].w = 100;
                ++panes;
            }
        }
    }
    ASSERT_GT(panes, 1000u);
    const objects::ClusterTree tree = objects::build_cluster_tree(scene, {.threads = 2});
    const double middle = 0.5 * kColumns * bench::kCityCell_m;
    std::vector<Moment> above, below;
    for (int frame = 0; frame < 40; ++frame) {
        const double angle = 0.1 * frame;
        const glm::dvec3 eye(middle + 30.0 * std::cos(angle), middle + 30.0 * std::sin(angle), 160.0);
        above.push_back({lod::look_at(eye, {middle, middle, 0.0}, {0.0, 1.0, 0.0}, optics()), 0.0});
        const glm::dvec3 street(30.0 + 2.0 * frame, 12.0 * bench::kCityCell_m, 2.0);
        below.push_back(
            {lod::look_at(street, street + glm::dvec3(100.0, 20.0, 0.0), {0.0, 0.0, 1.0}, optics()), 0.0});
    }
    std::vector<Moment> both = above;
    both.insert(both.end(), below.begin(), below.end());
    EXPECT_EQ(compare(tree, both, 1.0).frames_that_differ, 0u);
    const Tally seen = compare(tree, above, 1.0);
    EXPECT_GT(10 * seen.showing_triangles, 9 * seen.drawn_triangles)
        << "nothing is asked all over the picture";
}

/// Houses that come and go, each at its own times, and one in `driving` of them that drives about in between.
data::TimedScene restless_city(uint32_t driving) {
    data::TimedScene scene = bench::prism_city(kColumns * kColumns, kColumns);
    scene.end_s = 100.0;
    lod::Rng rng(4);
    for (data::TimedObject& object : scene.objects) {
        const double first_s = rng.between(0.0, 50.0), last_s = rng.between(50.0, 100.0);
        const auto step = static_cast<uint32_t>(scene.steps.size());
        scene.steps.push_back({0.0, rng.below(3) == 0});
        scene.steps.push_back({first_s, rng.below(3) != 0});
        scene.steps.push_back({last_s, rng.below(3) != 0});
        object.steps = {step, step + 3};
        if (rng.below(driving) != 0) continue;
        const auto key = static_cast<uint32_t>(scene.keys.size());
        const data::KeyFrame home = scene.keys[object.keys.begin];
        scene.keys.push_back(home);
        scene.keys.push_back({50.0, home.position + glm::dvec3(60.0, 0.0, 0.0), {0.0, 0.0, 0.0, 1.0}});
        scene.keys.push_back({100.0, home.position, home.rotation});
        object.keys = {key, key + 3};
    }
    return scene;
}

/// What hides comes, goes and is carried about; the time runs and jumps both ways.
TEST(HiddenClusters, HousesThatComeAndGoLookTheSameAtAnyTime) {
    const objects::ClusterTree tree = objects::build_cluster_tree(restless_city(8), {.threads = 2});
    lod::Rng rng(5);
    std::vector<Moment> moments;
    double time_s = 20.0;
    for (int frame = 0; frame < 160; ++frame) {
        const double stops = frame / 8 * 8.0;  // the eye stands for eight frames
        const glm::dvec3 eye(30.0 + 1.5 * (frame % 16 < 8 ? stops : frame), 12.0 * bench::kCityCell_m, 2.0);
        const glm::dvec3 ahead(100.0, 40.0 * std::sin(0.05 * stops), 0.0);
        time_s = frame % 10 == 9 ? rng.between(0.0, 100.0) : time_s + (frame % 20 < 10 ? 0.2 : -0.2);
        moments.push_back({lod::look_at(eye, eye + ahead, {0.0, 0.0, 1.0}, optics()), time_s});
    }
    const Tally tally = compare(tree, moments, 2.0);
    EXPECT_EQ(tally.frames_that_differ, 0u);
    EXPECT_LT(tally.drawn_triangles, 3 * tally.triangles / 4);
}

/// The eye stands, nothing drives: only houses that come and go uncover something.
TEST(HiddenClusters, AnEyeThatStandsSeesWhatAVanishedHouseHid) {
    const objects::ClusterTree tree = objects::build_cluster_tree(restless_city(1'000'000), {.threads = 2});
    const glm::dvec3 eye(60.0, 12.0 * bench::kCityCell_m, 2.0);
    const lod::View view = lod::look_at(eye, eye + glm::dvec3(100.0, 20.0, 0.0), {0.0, 0.0, 1.0}, optics());
    std::vector<Moment> moments;
    for (int frame = 0; frame < 200; ++frame)
        moments.push_back({view, 0.5 * (frame < 100 ? frame : 200 - frame) + 25.0});
    const Tally tally = compare(tree, moments, 2.0);
    EXPECT_EQ(tally.frames_that_differ, 0u);
    EXPECT_LT(tally.drawn_triangles, tally.triangles);
}

}  // namespace
