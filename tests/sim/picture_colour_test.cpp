// Colours of what is drawn of timed scenes beside everything: what an eye notices pixel by pixel, and the mean light of
// squares of pixels, which surfaces in the light of their other side, or without their windows, would change.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "objects/clustering/cluster_build.h"
#include "tests/bench/prism_city.h"
#include "tests/objects/small_scenes.h"
#include "tests/sim/seen_difference.h"
#include "tests/sim/site_excerpt.h"
#include "tests/sim/two_pictures.h"

namespace {

using sim_test::SeenDifference;
using sim_test::TwoPictures;

constexpr int kWidth_px = 320, kHeight_px = 180, kFactor = 4, kSquare_px = 16;

/// The most by which two pictures may differ.
struct Ceilings {
    double mean, noticeable_share;       ///< of pixels
    double mean_square, largest_square;  ///< of squares
};

struct Moment {
    glm::dvec3 eye, target;
    double time_s;
    Ceilings most[2];  ///< within 1 px and 2 px
};

void expect_same_colours(const std::string& name, const data::TimedScene& scene,
                         std::span<const Moment> moments) {
    objects::ClusterTree tree = objects::build_cluster_tree(scene, {.threads = 2});
    auto renderer = TwoPictures::make_renderer(tree, kFactor * kWidth_px, kFactor * kHeight_px);
    if (!renderer) GTEST_SKIP() << renderer.message();
    TwoPictures pictures(std::move(tree), std::move(*renderer));
    const lod::View optics{.fov_y_rad = 0.8, .width_px = kWidth_px, .height_px = kHeight_px};
    for (size_t i = 0; i < 2 * moments.size(); ++i) {
        const Moment& moment = moments[i / 2];
        const Ceilings& most = moment.most[i % 2];
        const double tolerance_px = i % 2 == 0 ? 1.0 : 2.0;
        const lod::View view = lod::look_at(moment.eye, moment.target, {0.0, 0.0, 1.0}, optics);
        const TwoPictures::Colours seen = pictures.colours(view, moment.time_s, tolerance_px, kFactor);
        const SeenDifference pixels =
            sim_test::seen_difference(seen.full, seen.drawn, kFactor, seen.is_covered);
        const SeenDifference squares =
            sim_test::square_difference(seen.full, seen.drawn, kFactor, kSquare_px, seen.is_covered);
        const std::string stem = testing::TempDir() + name + std::to_string(i);
        SCOPED_TRACE(stem + "_full.png, …_drawn.png");
        std::printf("%s %zu, %.0f px: pixels %.2f, %.3f noticeable; squares %.2f, %.2f at most\n",
                    name.c_str(), i / 2, tolerance_px, pixels.mean, pixels.noticeable_share, squares.mean,
                    squares.largest);
        EXPECT_GT(pixels.pixels, 3'000u);
        EXPECT_LT(seen.drawn_triangles, seen.full_triangles);
        EXPECT_LT(pixels.mean, most.mean);
        EXPECT_LT(pixels.noticeable_share, most.noticeable_share);
        EXPECT_LT(squares.mean, most.mean_square);
        EXPECT_LT(squares.largest, most.largest_square);
        if (!testing::Test::HasFailure()) continue;
        EXPECT_TRUE(render::write_png(stem + "_full.png", seen.full));
        EXPECT_TRUE(render::write_png(stem + "_drawn.png", seen.drawn));
    }
}

/// Ceilings are a fifth above what was measured.
TEST(PictureColour, ConstructionSite) {
    const Moment moments[] = {
        // across the site
        {{190.0, -190.0, 110.0}, {0.0, 0.0, 10.0}, 600.0, {{0.61, 0.028, 0.4, 2.3}, {1.1, 0.077, 0.74, 3.1}}},
        // all of it
        {{-330.0, -250.0, 160.0},
         {0.0, 0.0, 20.0},
         1200.0,
         {{0.91, 0.049, 0.53, 3.2}, {1.1, 0.082, 0.67, 5.3}}},
        // from a crane's height
        {{60.0, 150.0, 30.0}, {0.0, 0.0, 15.0}, 900.0, {{0.82, 0.082, 0.52, 15}, {0.92, 0.096, 0.54, 11}}},
        // from above, at the end
        {{20.0, -30.0, 420.0}, {0.0, 0.0, 0.0}, 3600.0, {{0.9, 0.052, 0.49, 2.8}, {1.1, 0.082, 0.68, 7.8}}},
        // low and far, before it is cleared
        {{500.0, 420.0, 90.0}, {0.0, 0.0, 20.0}, 100.0, {{0.36, 0.024, 0.26, 8.6}, {0.52, 0.049, 0.37, 8.9}}},
    };
    expect_same_colours("site", sim_test::site_excerpt(), moments);
}

/// Slabs of lawn and paving side by side with roads on them, all of which become sheets.
data::TimedScene park() {
    objects::FaceSoup lawn, paving, road;
    for (int i = 0; i < 9; ++i) {
        const glm::dvec3 low(28.0 * (i % 3) - 42.0, 28.0 * (i / 3) - 42.0, -0.3),
            high = low + glm::dvec3(28, 28, 0.3);
        if (i != 4) objects_test::add_box(low, high, {90, 120, 60, 255}, lawn);  // around a pond: no prism
        objects_test::add_box(low, high, {186, 181, 171, 255}, paving);
    }
    objects_test::add_box({-250, -4, 0.0}, {250, 4, 0.12}, {84, 84, 88, 255}, road);
    data::TimedScene scene;
    scene.end_s = 1.0;
    for (const objects::FaceSoup& soup : {lawn, paving, road})
        scene.meshes.push_back(objects_test::mesh_of(soup));
    const auto add = [&](uint32_t mesh, const glm::dvec3& at, const glm::dquat& turn) {
        const uint32_t key = static_cast<uint32_t>(scene.keys.size());
        scene.keys.push_back({0.0, at, turn});
        scene.objects.push_back({mesh, {0, 0}, {key, key + 1}, std::to_string(key)});
    };
    for (int i = 0; i < 36; ++i)
        add(i % 5 == 0 ? 1 : 0, {84.0 * (i % 6) - 210.0, 84.0 * (i / 6) - 210.0, 0.0}, {1, 0, 0, 0});
    for (const double y : {-168.0, 0.0, 84.0})
        add(2, {0.0, y, 0.0}, {1, 0, 0, 0});
    return scene;
}

/// What is flat keeps the light of its upper side.
TEST(PictureColour, Park) {
    const Moment moments[] = {
        {{0.0, -420.0, 120.0}, {0.0, 0.0, 0.0}, 0.0, {{0.3, 0.01, 0.2, 0.6}, {0.3, 0.022, 0.2, 1.4}}},
        {{600.0, 300.0, 400.0}, {0.0, 0.0, 0.0}, 0.0, {{0.3, 0.01, 0.2, 0.6}, {0.3, 0.01, 0.2, 0.6}}},
        {{-900.0, 700.0, 900.0}, {0.0, 0.0, 0.0}, 0.0, {{0.3, 0.01, 0.2, 0.6}, {0.68, 0.086, 0.24, 0.9}}},
    };
    expect_same_colours("park", park(), moments);
}

/// Round towers with few sides: the light of a side is off by what its normal is.
TEST(PictureColour, City) {
    const Moment moments[] = {
        {{-60.0, -60.0, 60.0}, {180.0, 180.0, 0.0}, 0.0, {{2.7, 0.46, 1.2, 5.2}, {4.4, 0.68, 2.1, 5.7}}},
        {{500.0, 200.0, 120.0}, {180.0, 180.0, 0.0}, 0.0, {{2.4, 0.37, 1.3, 4.4}, {3.9, 0.6, 1.9, 8.4}}},
        {{190.0, 200.0, 600.0}, {190.0, 190.0, 0.0}, 0.0, {{1.3, 0.12, 0.54, 1.1}, {3.9, 0.66, 1.7, 3.2}}},
    };
    expect_same_colours("city", bench::prism_city(900, 30), moments);
}

/// The last view is from so far away that 2 px are 9 m, and several towers share a face.
TEST(PictureColour, LargerCity) {
    const Moment moments[] = {
        {{-60.0, -60.0, 60.0}, {180.0, 180.0, 0.0}, 0.0, {{2.8, 0.48, 1.2, 4.3}, {4.1, 0.64, 1.8, 4.9}}},
        {{500.0, 200.0, 120.0}, {180.0, 180.0, 0.0}, 0.0, {{2.6, 0.4, 1.4, 7.4}, {3.6, 0.57, 1.8, 7.2}}},
        {{190.0, 200.0, 600.0}, {190.0, 190.0, 0.0}, 0.0, {{1.4, 0.16, 0.56, 1.4}, {4.1, 0.68, 1.9, 4.6}}},
        {{-480.0, -350.0, 330.0}, {250.0, 250.0, 0.0}, 0.0, {{4, 0.76, 1.6, 3.5}, {6.4, 0.99, 2.7, 6}}},
    };
    expect_same_colours("larger_city", bench::prism_city(1600, 40), moments);
}

}  // namespace
