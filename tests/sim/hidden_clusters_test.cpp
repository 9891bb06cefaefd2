// What solids hide is left out of the picture, and the picture is the same to the bit.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "lod/scheduler.h"
#include "objects/cluster_front.h"
#include "objects/clustering/cluster_build.h"
#include "render/renderer.h"
#include "tests/bench/prism_city.h"

namespace {

constexpr int kColumns = 24;
constexpr double kTolerance_px = 2.0;

/// The middle of a front's picture-making: one frame, to its end.
struct Artist {
    Artist(objects::ClusterTree tree, bool looks_through) : front(std::move(tree), {}, looks_through) {}

    void adapt(const lod::View& view, double time_s) {
        lod::Front* const fronts[] = {&front};
        lod::Budget budget;
        budget.tolerance_px = kTolerance_px;
        budget.coarsen_ratio = 1.0;  // so that the cut follows from the view alone
        front.begin_frame({&view, 1}, time_s);
        lod::schedule(fronts, budget, lod::operation_limit(UINT64_MAX));
    }
    void draw(const lod::View& view, render::Renderer& renderer) {
        list.clear();
        front.emit(view, list);
        render::Atmosphere air;
        air.draw_sky = false;
        air.visibility_m = std::numeric_limits<double>::infinity();
        renderer.draw(view, list, air);
    }

    objects::ClusterFront front;
    lod::DrawList list;
};

/// Each front has its own renderer, as both write the pool once.
render::Renderer make_renderer(const objects::ClusterTree& tree, const lod::View& view) {
    render::RendererOptions options;
    options.width_px = view.width_px;
    options.height_px = view.height_px;
    options.pool = {static_cast<uint32_t>(tree.vertices.size()), static_cast<uint32_t>(tree.indices.size()),
                    4 * tree.object_count + 64};
    auto renderer = render::Renderer::create(options);
    EXPECT_TRUE(renderer) << renderer.message();
    return std::move(*renderer);
}

TEST(HiddenClusters, ADrivePastHousesLooksTheSameAndDrawsAFraction) {
    const objects::ClusterTree tree =
        objects::build_cluster_tree(bench::prism_city(kColumns * kColumns, kColumns), {.threads = 2});
    lod::View optics;
    optics.width_px = 320;
    optics.height_px = 180;
    optics.near_m = 0.5;
    optics.fov_y_rad = 0.8;
    Artist all(tree, true), some(tree, false);
    render::Renderer canvas = make_renderer(tree, optics);
    uint64_t all_triangles = 0, some_triangles = 0;
    size_t wrong = 0;
    for (int frame = 0; frame < 120; ++frame) {
        const double along_m = 30.0 + 1.5 * frame;
        const glm::dvec3 eye(along_m, 12.0 * bench::kCityCell_m, 2.0 + 20.0 * (frame % 40 == 39));
        const glm::dvec3 ahead(100.0, 40.0 * std::sin(0.05 * frame), 0.0);
        const lod::View view = lod::look_at(eye, eye + ahead, {0.0, 0.0, 1.0}, optics);
        all.adapt(view, 0.0);
        some.adapt(view, 0.0);
        all.front.place(all.front.pool_need());
        all.draw(view, canvas);
        const render::ColourImage whole = canvas.read_colour();
        some.front.place(some.front.pool_need());
        some.draw(view, canvas);
        wrong += canvas.read_colour().rgba != whole.rgba;
        ASSERT_EQ(some.front.validate(), "");
        EXPECT_LE(some.front.error_px(), kTolerance_px) << "frame " << frame;
        if (frame == 0) continue;  // nothing has been drawn that could hide anything
        all_triangles += all.front.emitted_triangles();
        some_triangles += some.front.emitted_triangles();
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_LT(some_triangles, all_triangles / 2);
    RecordProperty("triangles_in_all", std::to_string(all_triangles));
    RecordProperty("triangles_drawn", std::to_string(some_triangles));
}

}  // namespace
