// How surfaces, air and sky look, as far as mathematics can say it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/render/scene_kit.h"

namespace {

using namespace render_test;
using lod::Material;

/// Eye at the origin of a level world, looking north (+y).
lod::View level_view(int width_px, int height_px) {
    return lod::look_at({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, view_of_size(width_px, height_px));
}

/// Sum of the channels in the middle of a rectangle of one material that fills the picture.
int brightness(Material material, const glm::vec3& normal, render::Renderer& renderer) {
    const lod::View view = level_view(32, 32);
    Scene scene;
    add_quad(rectangle(view, {-16, -16}, {16, 16}, 5.0),
             {.colour = {180, 180, 180}, .material = material, .normal = normal}, scene);
    render::Atmosphere atmosphere = vacuum();
    atmosphere.sun_world = glm::normalize(glm::dvec3(1.0, -0.5, 0.5));
    draw(view, atmosphere, scene, renderer);
    const auto colour = renderer.read_colour();
    return channel(colour, 16, 16, 0) + channel(colour, 16, 16, 1) + channel(colour, 16, 16, 2);
}

TEST_F(RendererTest, LightFallsFromTheSunAndTheSky) {
    RENDERER_OR_SKIP(renderer, 32, 32);
    for (const Material material :
         {Material::kWall, Material::kRoof, Material::kPaint, Material::kWallFoot}) {
        EXPECT_GT(brightness(material, {1, 0, 0}, renderer), brightness(material, {-1, 0, 0}, renderer) + 60);
        EXPECT_GT(brightness(material, {-1, 0, 0}, renderer),
                  brightness(material, {0, 0, -1}, renderer) + 15);
    }
    EXPECT_EQ(brightness(Material::kGlow, {0, 0, -1}, renderer), 3 * 180);
}

using Light = std::array<double, 3>;  // red, green, blue, linear up to a factor

/// Of a rectangle that fills the picture.
Light light_of(const lod::View& view, const glm::dvec3& sun, const std::function<void(lod::Vertex&)>& set,
               render::Renderer& renderer) {
    Scene scene;
    add_quad(rectangle(view, {-16, -16}, {16, 16}, 5.0), {}, scene);
    std::for_each(scene.vertices.begin(), scene.vertices.end(), set);
    render::Atmosphere atmosphere = vacuum();
    atmosphere.sun_world = sun;
    draw(view, atmosphere, scene, renderer);
    const auto colour = renderer.read_colour();
    Light light{};
    for (int k = 0; k < 3; ++k)
        light[size_t(k)] = std::pow(channel(colour, 16, 16, k), 2.0);
    return light;
}

/// … of paint that looks one way, without its sheen, which is all that black paint shows.
Light light_one_way(const lod::View& view, const glm::dvec3& sun, const glm::dvec3& normal,
                    render::Renderer& renderer) {
    const auto with = [&](const glm::u8vec3& colour) {
        return light_of(
            view, sun,
            [&](lod::Vertex& v) {
                v = lod::make_vertex(lod::position_of(v), glm::vec3(normal), colour, Material::kPaint);
            },
            renderer);
    };
    Light light = with({200, 180, 160});
    const Light sheen = with({0, 0, 0});
    for (size_t k = 0; k < 3; ++k)
        light[k] -= sheen[k];
    return light;
}

/// A round tower's light is the mean of what is seen of it, strip by strip and its roof.
TEST_F(RendererTest, WhatStandsForSurfacesAllRoundHasTheirMeanLight) {
    RENDERER_OR_SKIP(renderer, 32, 32);
    const int strips = 72;
    for (const double up_share : {0.0, 0.1, 0.6}) {
        for (const double sun_deg : {0.0, 50.0, 110.0, 180.0}) {
            for (const double down : {0.0, 0.4, 2.0}) {
                lod::View narrow = view_of_size(32, 32);
                narrow.fov_y_rad = 0.01;
                const lod::View view = lod::look_at({0, 0, 0}, {0, 1, -down}, {0, 0, 1}, narrow);
                const glm::dvec3 towards_eye = glm::normalize(glm::dvec3(0, -1, down));
                const double angle = glm::radians(sun_deg);
                const glm::dvec3 sun = glm::normalize(glm::dvec3(std::sin(angle), -std::cos(angle), 0.7));
                Light sum{};
                double weight = 0.0;
                const auto add = [&](const glm::dvec3& normal, double area) {
                    const double seen = area * std::max(glm::dot(normal, towards_eye), 0.0);
                    if (!(seen > 0.0)) return;
                    const Light light = light_one_way(view, sun, normal, renderer);
                    for (size_t k = 0; k < 3; ++k)
                        sum[k] += seen * light[k];
                    weight += seen;
                };
                for (int i = 0; i < strips; ++i) {
                    const double turn = 2.0 * std::numbers::pi * (i + 0.5) / strips;
                    add({std::cos(turn), std::sin(turn), 0.0}, (1.0 - up_share) / strips);
                }
                add({0, 0, 1}, up_share);
                const Light light = light_of(
                    view, sun,
                    [&](lod::Vertex& v) {
                        v = lod::make_all_round_vertex(lod::position_of(v), up_share, {200, 180, 160});
                    },
                    renderer);
                for (size_t k = 0; k < 3; ++k)
                    EXPECT_NEAR(std::sqrt(light[k]), std::sqrt(sum[k] / weight), 2.5)
                        << up_share << " " << sun_deg << " " << down;
            }
        }
    }
}

TEST_F(RendererTest, TheGroundTextureHasItsTexelsOnTheSamples) {
    RENDERER_OR_SKIP(renderer, 120, 120);
    constexpr int kGrid = 5;
    std::vector<uint8_t> rgba;
    for (int row = 0; row < kGrid; ++row) {
        for (int col = 0; col < kGrid; ++col) {
            rgba.insert(rgba.end(), {uint8_t(50 * col), uint8_t(50 * row), uint8_t(7 * col * row), 255});
        }
    }
    ASSERT_TRUE(renderer.set_ground_texture(kGrid, kGrid, rgba, kGrid, kGrid));
    const lod::View view = level_view(120, 120);
    Scene scene;
    // Samples are 24 px apart; sample (0, 0) lies at pixel (12.5, 12.5), on a pixel's centre.
    add_quad(rectangle(view, {-47.5, -48.5}, {48.5, 47.5}, 5.0),
             {.colour = {255, 255, 255}, .material = Material::kGround}, scene);
    const uint16_t last = kGrid - 1;
    const std::array<std::array<uint16_t, 2>, 6> sample{
        {{0, last}, {last, last}, {last, 0}, {0, last}, {last, 0}, {0, 0}}};
    for (size_t i = 0; i < 6; ++i)
        std::copy_n(sample[i].begin(), 2, scene.vertices[i].surface);
    draw(view, vacuum(), scene, renderer);
    const auto colour = renderer.read_colour();
    for (int row = 0; row < kGrid; ++row) {
        for (int col = 0; col < kGrid; ++col) {
            // The border samples lie on the quad's edge: look one pixel inside, a 24th of a texel away.
            const int x = std::clamp(12 + 24 * col, 13, 107), y = std::clamp(12 + 24 * row, 13, 107);
            EXPECT_NEAR(channel(colour, x, y, 0), 50 * col, 3) << col << "," << row;
            EXPECT_NEAR(channel(colour, x, y, 1), 50 * row, 3) << col << "," << row;
            EXPECT_NEAR(channel(colour, x, y, 2), 7 * col * row, 3) << col << "," << row;
        }
    }
}

TEST_F(RendererTest, ABadGroundTextureIsRefusedAndTheOldOneStays) {
    RENDERER_OR_SKIP(renderer, 16, 16);
    const std::vector<uint8_t> rgba(16);
    constexpr std::array<uint8_t, 4> kGood{9, 8, 7, 255};
    ASSERT_TRUE(renderer.set_ground_texture(1, 1, kGood, 1, 1));
    EXPECT_FALSE(renderer.set_ground_texture(3, 3, rgba, 3, 3));
    EXPECT_FALSE(renderer.set_ground_texture(0, 4, rgba, 1, 1));
    EXPECT_FALSE(renderer.set_ground_texture(1 << 24, 1, rgba, 1, 1));
    const lod::View view = level_view(16, 16);
    Scene scene;
    add_quad(rectangle(view, {-8, -8}, {8, 8}, 5.0),
             {.colour = {255, 255, 255}, .material = Material::kGround}, scene);
    draw(view, vacuum(), scene, renderer);
    EXPECT_EQ(pixel(renderer.read_colour(), 8, 8), 0x090807u);
}

TEST_F(RendererTest, HazeLeavesTwentiethOfTheContrastAtTheVisibility) {
    RENDERER_OR_SKIP(renderer, 256, 256);
    const lod::View view = level_view(256, 256);
    render::Atmosphere air;
    air.visibility_m = 20000.0;
    for (const auto& [share_of_visibility, contrast] :
         {std::pair{1.0, 0.05}, std::pair{0.5, std::sqrt(0.05)}}) {
        Scene scene;
        const double depth_m = share_of_visibility * air.visibility_m;
        add_quad(rectangle(view, {-4, -4}, {0, 4}, depth_m), {.colour = {0, 0, 0}}, scene);
        add_quad(rectangle(view, {0, -4}, {4, 4}, depth_m), {.colour = {255, 255, 255}}, scene);
        draw(view, air, scene, renderer);
        const auto colour = renderer.read_colour();
        for (int which = 0; which < 3; ++which) {
            const int difference = channel(colour, 129, 128, which) - channel(colour, 126, 128, which);
            EXPECT_NEAR(difference, 255 * contrast, 2.0);
        }
    }
}

TEST_F(RendererTest, HazeThinsWithHeight) {
    RENDERER_OR_SKIP(renderer, 16, 16);
    const lod::View view = level_view(16, 16);
    int last = 255;
    for (const double height_m : {0.0, 1000.0, 4000.0, 12000.0}) {
        Scene scene;
        add_quad(rectangle(view, {-8, -8}, {8, 8}, 20000.0), {.colour = {0, 0, 0}}, scene);
        render::Atmosphere air;
        air.eye_height_m = height_m;
        draw(view, air, scene, renderer);
        const int red = channel(renderer.read_colour(), 8, 8, 0);
        EXPECT_LT(red, last - 5) << "black is hazed less at " << height_m << " m";
        last = red;
    }
}

TEST_F(RendererTest, WhatHazeSwallowsMeltsIntoTheSky) {
    RENDERER_OR_SKIP(renderer, 96, 64);
    const lod::View view = level_view(96, 64);
    Scene nothing, far_wall;
    draw(view, render::Atmosphere{}, nothing, renderer);
    const auto sky = renderer.read_colour();
    add_quad(rectangle(view, {-48, -20}, {48, 1}, 400000.0), {.colour = {0, 0, 0}}, far_wall);
    draw(view, render::Atmosphere{}, far_wall, renderer);
    const auto wall = renderer.read_colour();
    EXPECT_FALSE(std::isinf(depth_at(renderer.read_depth(), 48, 36)));
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 96; ++x) {
            for (int which = 0; which < 3; ++which) {
                EXPECT_NEAR(channel(sky, x, y, which), channel(wall, x, y, which), 2) << x << "," << y;
            }
        }
    }
}

TEST_F(RendererTest, TheSkyCoversTheBackgroundAndDeepensUpwards) {
    RENDERER_OR_SKIP(renderer, 64, 64);
    lod::View view = level_view(64, 64);
    view.fov_y_rad = 2.0;
    Scene nothing;
    render::Atmosphere air;
    air.sun_world = {0, -1, 0};
    draw(view, air, nothing, renderer);
    const auto colour = renderer.read_colour();
    for (int y = 1; y < 30; ++y)
        EXPECT_LE(channel(colour, 32, y - 1, 0), channel(colour, 32, y, 0) + 1) << y;
    EXPECT_GT(channel(colour, 32, 0, 2), channel(colour, 32, 0, 0) + 60) << "blue above";
    EXPECT_TRUE(std::isinf(depth_at(renderer.read_depth(), 32, 32))) << "the sky has no depth";
    for (int y = 0; y < 64; ++y)
        EXPECT_NE(pixel(colour, 32, y), 0xff00ffu);

    air.sun_world = glm::normalize(glm::dvec3(0, 1, 0.05));
    view.fov_y_rad = 0.2;
    draw(view, air, nothing, renderer);
    const auto sun_px = project(view, view.eye_world + air.sun_world);
    EXPECT_GT(channel(renderer.read_colour(), int(sun_px.x), int(sun_px.y), 0), 240) << "the sun's disc";
}

TEST_F(RendererTest, GlassLetsWhatIsBehindThroughWhateverItsPlaceInTheList) {
    RENDERER_OR_SKIP(renderer, 32, 32);
    const lod::View view = level_view(32, 32);
    Scene scene;
    add_quad(rectangle(view, {-8, -8}, {8, 8}, 1.0),
             {.material = Material::kGlass, .normal = {0, -1, 0}, .is_glass = true}, scene);
    add_quad(rectangle(view, {-16, -16}, {16, 16}, 5.0), {.colour = {200, 0, 0}}, scene);
    draw(view, vacuum(), scene, renderer);
    const auto colour = renderer.read_colour();
    EXPECT_EQ(pixel(colour, 2, 2), 0xc80000u);
    EXPECT_GT(channel(colour, 16, 16, 0), 180) << "red shines through";
    EXPECT_GT(channel(colour, 16, 16, 2), 8) << "and the pane reflects a little sky";
    EXPECT_LT(channel(colour, 16, 16, 2), 80);
}

}  // namespace
