#include "render/renderer.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "lod/base/rng.h"
#include "render/guard_band.h"
#include "tests/render/scene_kit.h"

namespace {

using namespace render_test;

/// Signed distance of a picture point from the line a-b in pixels, positive on the left of a to b.
double side_px(const glm::dvec3& a, const glm::dvec3& b, double x, double y) {
    return ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / std::hypot(b.x - a.x, b.y - a.y);
}

/// How far inside the triangle a point is, in pixels; negative outside.
double depth_inside_px(const std::array<glm::dvec3, 3>& t, double x, double y) {
    const std::array<double, 3> sides{side_px(t[0], t[1], x, y), side_px(t[1], t[2], x, y),
                                      side_px(t[2], t[0], x, y)};
    const double inside = *std::min_element(sides.begin(), sides.end());
    return std::max(inside, -*std::max_element(sides.begin(), sides.end()));  // either winding
}

/// Depth where a pixel's ray meets the triangle's plane.
double plane_depth_m(const lod::View& view, const std::array<glm::dvec3, 3>& world, double x, double y) {
    const double lambda_px = view.height_px / (2.0 * std::tan(view.fov_y_rad / 2.0));
    const glm::dvec3 ray((x - view.width_px / 2.0) / lambda_px, (view.height_px / 2.0 - y) / lambda_px, -1.0);
    const glm::dvec3 a = view.eye_from_world * (world[0] - view.eye_world);
    const glm::dvec3 normal = view.eye_from_world * glm::cross(world[1] - world[0], world[2] - world[0]);
    return glm::dot(normal, a) / glm::dot(normal, ray);
}

void expect_triangles_land_where_double_precision_puts_them(int width_px, int height_px, int rounds,
                                                            render::Renderer& renderer) {
    lod::Rng rng(11);
    for (int round = 0; round < rounds; ++round) {
        const auto random = [&rng](double reach) {
            return glm::dvec3(rng.between(-reach, reach), rng.between(-reach, reach),
                              rng.between(-reach, reach));
        };
        const glm::dvec3 centre = random(1e6);
        const lod::View view =
            lod::look_at(centre + random(300.0), centre, {0, 0, 1}, view_of_size(width_px, height_px));
        const std::array<glm::dvec3, 3> world{centre + random(60.0), centre + random(60.0),
                                              centre + random(60.0)};
        Scene scene;
        add_triangle(world, {.colour = {10, 200, 30}}, scene);
        draw(view, vacuum(), scene, renderer);
        const auto colour = renderer.read_colour();
        const auto depth = renderer.read_depth();

        const std::array<glm::dvec3, 3> on_picture{project(view, world[0]), project(view, world[1]),
                                                   project(view, world[2])};
        if (std::min({on_picture[0].z, on_picture[1].z, on_picture[2].z}) < view.near_m) continue;
        for (int y = 0; y < height_px; ++y) {
            for (int x = 0; x < width_px; ++x) {
                const double inside = depth_inside_px(on_picture, x + 0.5, y + 0.5);
                if (std::abs(inside) < 0.05) continue;
                ASSERT_EQ(pixel(colour, x, y), inside > 0 ? 0x0ac81eu : 0xff00ffu)
                    << "round " << round << " pixel " << x << "," << y << " inside by " << inside;
                if (inside < 0) continue;
                const double expected_m = plane_depth_m(view, world, x + 0.5, y + 0.5);
                EXPECT_NEAR(double(depth_at(depth, x, y)), expected_m, 1e-3 * expected_m);
            }
        }
    }
}

TEST_F(RendererTest, TrianglesLandWhereDoublePrecisionPutsThem) {
    RENDERER_OR_SKIP(renderer, 320, 200);
    expect_triangles_land_where_double_precision_puts_them(320, 200, 20, renderer);
}

void expect_the_sky_from_edge_to_edge(int width_px, int height_px, render::Renderer& renderer) {
    Scene nothing;
    render::Atmosphere air = vacuum();
    air.draw_sky = true;
    draw(view_of_size(width_px, height_px), air, nothing, renderer);
    const auto sky = renderer.read_colour();
    for (const int x : {0, width_px / 2, width_px - 1})
        EXPECT_NE(pixel(sky, x, height_px / 2), 0xff00ffu) << "no sky at " << x << " of " << width_px;
}

TEST_F(RendererTest, UsualPicturesHaveAGuardBand) {
    RENDERER_OR_SKIP(renderer, 16, 16);
    if (!renderer.is_software()) GTEST_SKIP() << "the room for viewports is the driver's";
    EXPECT_EQ(render::guard_ratio(640, 360), 4);
    EXPECT_EQ(render::guard_ratio(3840, 2160), 4);
    EXPECT_EQ(render::guard_ratio(6001, 9), 2);
    EXPECT_EQ(render::guard_ratio(9, 6001), 2);
    EXPECT_EQ(render::guard_ratio(12000, 9), 1);
}

// Where viewports may have 16,384 px, as on Mesa's rasteriser, half of the usual guard band fits around this picture.
TEST_F(RendererTest, WidePicturesHaveNarrowerGuardBands) {
    RENDERER_OR_SKIP(renderer, 6001, 9);
    expect_triangles_land_where_double_precision_puts_them(6001, 9, 12, renderer);
    expect_the_sky_from_edge_to_edge(6001, 9, renderer);
}

// And none around this one.
TEST_F(RendererTest, TheWidestPicturesHaveNoGuardBand) {
    RENDERER_OR_SKIP(renderer, 12000, 9);
    expect_triangles_land_where_double_precision_puts_them(12000, 9, 12, renderer);
    expect_the_sky_from_edge_to_edge(12000, 9, renderer);
}

TEST_F(RendererTest, NothingDrawnIsMagentaAndInfinitelyFar) {
    RENDERER_OR_SKIP(renderer, 33, 21);
    Scene scene;
    draw(view_of_size(33, 21), vacuum(), scene, renderer);
    const auto colour = renderer.read_colour();
    const auto depth = renderer.read_depth();
    for (int y = 0; y < 21; ++y) {
        for (int x = 0; x < 33; ++x) {
            ASSERT_EQ(pixel(colour, x, y), 0xff00ffu);
            ASSERT_EQ(depth_at(depth, x, y), std::numeric_limits<float>::infinity());
        }
    }
}

TEST_F(RendererTest, TheTopRowComesFirst) {
    RENDERER_OR_SKIP(renderer, 40, 30);
    const lod::View view = view_of_size(40, 30);
    Scene scene;
    add_quad(rectangle(view, {-20, 10}, {20, 15}, 5.0), {.colour = {255, 255, 255}}, scene);
    draw(view, vacuum(), scene, renderer);
    const auto colour = renderer.read_colour();
    const auto depth = renderer.read_depth();
    EXPECT_EQ(pixel(colour, 20, 4), 0xffffffu);
    EXPECT_EQ(pixel(colour, 20, 5), 0xff00ffu);
    EXPECT_NEAR(depth_at(depth, 0, 0), 5.0f, 1e-5f);
    EXPECT_TRUE(std::isinf(depth_at(depth, 0, 29)));
}

TEST_F(RendererTest, NearestWinsInAnyOrderAndTheNearPlaneCuts) {
    RENDERER_OR_SKIP(renderer, 32, 32);
    lod::View view = view_of_size(32, 32);
    view.near_m = 2.0;
    for (const bool is_near_first : {true, false}) {
        Scene scene;
        for (const bool is_near : {is_near_first, !is_near_first}) {
            add_quad(rectangle(view, {-16, -16}, {16, 16}, is_near ? 3.0 : 4.0),
                     {.colour = is_near ? glm::u8vec3(1, 2, 3) : glm::u8vec3(9, 9, 9)}, scene);
        }
        add_quad(rectangle(view, {-16, -16}, {16, 16}, 1.9), {.colour = {200, 0, 0}}, scene);
        draw(view, vacuum(), scene, renderer);
        EXPECT_EQ(pixel(renderer.read_colour(), 16, 16), 0x010203u);
    }
}

TEST_F(RendererTest, OneDrawCallAndNoAllocationOnceWarm) {
    RENDERER_OR_SKIP(renderer, 64, 36, 8);
    const lod::View view = view_of_size(64, 36);
    Scene scene;
    for (int i = 0; i < 3; ++i)
        add_quad(rectangle(view, {-9, -9}, {9, 9}, 2.0 + i), {}, scene);
    draw(view, render::Atmosphere{}, scene, renderer);
    EXPECT_GT(renderer.stats().allocations, 0u) << "the first frame made everything";
    for (int frame = 0; frame < 5; ++frame) {
        draw(view, render::Atmosphere{}, scene, renderer);
        EXPECT_EQ(renderer.stats().draw_calls, 1u);
        EXPECT_EQ(renderer.stats().allocations, 0u);
        EXPECT_EQ(renderer.stats().commands, 7u) << "six triangles and the sky";
        EXPECT_GE(renderer.stats().upload_bytes, 18 * (32 + 4) + 7 * 20 + 112u);
    }
}

/// Pages that this process had to have mapped so far.
long page_faults() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_minflt;
}

/// What a frame allocates and frees is not handed back to the system each time, to be cleared and mapped anew in the next.
TEST_F(RendererTest, AWarmFrameFaultsHardlyAPage) {
    RENDERER_OR_SKIP(renderer, 640, 360);
    const lod::View view = view_of_size(640, 360);
    Scene scene;
    lod::Rng rng(3);
    for (int i = 0; i < 30'000; ++i) {
        const glm::dvec2 at(rng.between(-320.0, 316.0), rng.between(-180.0, 176.0));
        add_quad(rectangle(view, at, at + 4.0, rng.between(2.0, 9.0)), {}, scene);
    }
    scene.list.items = {{.index_count = 180'000}};
    ASSERT_TRUE(renderer.resize_pool({.vertices = 180'000, .indices = 180'000, .commands = 64}));
    for (size_t i = 0; i < scene.indices.size(); ++i)
        scene.indices[i] = static_cast<uint32_t>(i);
    for (int frame = 0; frame < 3; ++frame)
        draw(view, vacuum(), scene, renderer);
    const long before = page_faults();
    for (int frame = 0; frame < 10; ++frame)
        draw(view, vacuum(), scene, renderer);
    const long faults = page_faults() - before;
    std::printf("%ld page faults in ten frames\n", faults);
    EXPECT_LT(faults, 500);
}

TEST_F(RendererTest, GrowsForMoreItemsThanPromisedAndCountsIt) {
    RENDERER_OR_SKIP(renderer, 64, 36, 2);
    const lod::View view = view_of_size(64, 36);
    Scene scene;
    for (int i = 0; i < 50; ++i)
        add_quad(rectangle(view, {-32.0 + i, -18}, {-31.0 + i, 18}, 2.0), {}, scene);
    draw(view, vacuum(), scene, renderer);
    EXPECT_GT(renderer.stats().allocations, 0u);
    EXPECT_EQ(renderer.stats().commands, 100u);
    draw(view, vacuum(), scene, renderer);
    EXPECT_EQ(renderer.stats().allocations, 0u);
    const auto colour = renderer.read_colour();
    for (int x = 0; x < 64; ++x)
        EXPECT_EQ(pixel(colour, x, 18), x < 50 ? 0xffffffu : 0xff00ffu) << x;
}

TEST_F(RendererTest, AResizedPoolDrawsAndCounts) {
    RENDERER_OR_SKIP(renderer, 32, 32);
    const lod::View view = view_of_size(32, 32);
    Scene scene;
    for (int i = 0; i < 1000; ++i)
        add_quad(rectangle(view, {-16, -16}, {16, 16}, 9.0), {}, scene);
    ASSERT_TRUE(renderer.resize_pool({.vertices = 6000, .indices = 6000, .commands = 2000}));
    draw(view, vacuum(), scene, renderer);
    EXPECT_GT(renderer.stats().allocations, 0u);
    EXPECT_EQ(pixel(renderer.read_colour(), 5, 5), 0xffffffu);
    draw(view, vacuum(), scene, renderer);
    EXPECT_EQ(renderer.stats().allocations, 0u);
}

TEST_F(RendererTest, WritesOutsideThePoolEndTheProgram) {
    RENDERER_OR_SKIP(renderer, 16, 16);
    const lod::View view = view_of_size(16, 16);
    Scene scene;
    add_triangle({glm::dvec3(0, 0, -1), {1, 0, -1}, {0, 1, -1}}, {}, scene);
    prepare(view, scene);
    scene.list.vertex_writes[0].first_vertex = 4094;
    EXPECT_DEATH(renderer.draw(view, scene.list, vacuum()), "CHECK failed");
}

TEST_F(RendererTest, EqualFramesGiveEqualBytes) {
    RENDERER_OR_SKIP(renderer, 160, 90);
    const lod::View view = lod::look_at({3, 4, 5}, {0, 0, 0}, {0, 0, 1}, view_of_size(160, 90));
    Scene scene;
    add_quad({glm::dvec3(-3, -3, 0), {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}}, {.material = lod::Material::kPaint},
             scene);
    draw(view, render::Atmosphere{}, scene, renderer);
    const auto colour = renderer.read_colour().rgba;
    const auto depth = renderer.read_depth().depth_m;
    draw(view, render::Atmosphere{}, scene, renderer);
    EXPECT_EQ(colour, renderer.read_colour().rgba);
    EXPECT_EQ(depth, renderer.read_depth().depth_m);
}

TEST_F(RendererTest, RefusesImpossibleSizesInOneLine) {
    for (const auto& [width, height] : {std::pair{0, 10}, std::pair{10, -1}, std::pair{1 << 20, 10}}) {
        render::RendererOptions options;
        options.width_px = width;
        options.height_px = height;
        const auto created = render::Renderer::create(options);
        ASSERT_FALSE(created);
        EXPECT_EQ(created.message().find('\n'), std::string::npos);
    }
}

TEST_F(RendererTest, InputIsAllZeroWithoutAWindow) {
    RENDERER_OR_SKIP(renderer, 16, 16);
    const auto input = renderer.poll_input();
    EXPECT_FALSE(input.close || input.pause || input.faster || input.slower);
    EXPECT_EQ(input.forward + input.right + input.up + input.yaw + input.pitch + input.roll, 0.0);
}

}  // namespace
