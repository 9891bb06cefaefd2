// Fine structure of surfaces: it is there near the eye, stays in its place, and is gone before it could sparkle.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "render/surface_pattern.h"
#include "tests/render/scene_kit.h"

namespace {

using namespace render_test;
using lod::Material;

constexpr int kWidth_px = 320, kHeight_px = 180;
constexpr render::SurfaceDetail kDetail{{render::kGroundTile_m, render::kGroundTile_m}, {0.8, 0.0, 0.6}};

/// Level ground of `side` x `side` samples, a tile apart, its middle below the eye; cut into `cuts`² quads.
Scene ground(int side, int cuts, int first_sample) {
    Scene scene;
    const double spacing_m = kDetail.cell_m.x;
    const auto place = [&](int cut) { return side * cut / cuts; };
    for (int row = 0; row < cuts; ++row) {
        for (int col = 0; col < cuts; ++col) {
            const std::array<glm::ivec2, 4> at{{{place(col), place(row)},
                                                {place(col + 1), place(row)},
                                                {place(col + 1), place(row + 1)},
                                                {place(col), place(row + 1)}}};
            for (const int k : {0, 1, 2, 0, 2, 3}) {
                const glm::ivec2 sample = at[static_cast<size_t>(k)];
                const glm::dvec2 from_middle = (glm::dvec2(sample) - side / 2.0) * spacing_m;
                lod::Vertex vertex = lod::make_vertex({from_middle.x, -from_middle.y, 0.0}, {0, 0, 1},
                                                      {255, 255, 255}, Material::kGround);
                lod::set_ground_sample(vertex, first_sample + sample.x, first_sample + sample.y);
                scene.vertices.push_back(vertex);
                scene.indices.push_back(static_cast<uint32_t>(scene.indices.size()));
            }
        }
    }
    scene.list.items.push_back({.index_count = static_cast<uint32_t>(scene.indices.size())});
    return scene;
}

/// One colour everywhere that leaves room above and below it.
void paint_ground(render::Renderer& renderer) {
    constexpr std::array<uint8_t, 4> kColour{130, 140, 90, 255};
    ASSERT_TRUE(renderer.set_ground_texture(1, 1, kColour, 1, 1));
}

/// From `height_m`, looking north and down by `pitch_rad`.
lod::View view_from(double height_m, double pitch_rad) {
    return lod::look_at({3.0, -7.0, height_m},
                        {3.0, -7.0 + std::cos(pitch_rad), height_m - std::sin(pitch_rad)}, {0, 0, 1},
                        view_of_size(kWidth_px, kHeight_px));
}

render::ColourImage picture(const lod::View& view, Scene& scene, render::Renderer& renderer, int sample) {
    render::Atmosphere air = vacuum();
    air.ground_sample = {sample, sample};
    draw(view, air, scene, renderer);
    return renderer.read_colour();
}

/// Mean difference of two pictures over rows [begin, end), levels of 255.
double difference(const render::ColourImage& a, const render::ColourImage& b, int begin, int end) {
    double sum = 0.0;
    for (int y = begin; y < end; ++y) {
        for (int x = 0; x < kWidth_px; ++x) {
            for (int which = 0; which < 3; ++which)
                sum += std::abs(channel(a, x, y, which) - channel(b, x, y, which));
        }
    }
    return sum / (3.0 * kWidth_px * (end - begin));
}

TEST_F(RendererTest, GroundHasStructureNearTheEyeAndItsMeanFarAway) {
    RENDERER_OR_SKIP(renderer, kWidth_px, kHeight_px);
    paint_ground(renderer);
    Scene scene = ground(600, 10, 0);
    const lod::View view = view_from(120.0, 0.2);
    const auto plain = picture(view, scene, renderer, 300);
    renderer.set_detail(kDetail);
    const auto detailed = picture(view, scene, renderer, 300);
    int horizon = 0;
    while (channel(plain, kWidth_px / 2, horizon, 1) == 0)  // magenta has no green
        ++horizon;
    EXPECT_LT(difference(plain, detailed, horizon + 1, horizon + 12), 0.8) << "beyond 2 km: the mean";
    EXPECT_GT(difference(plain, detailed, kHeight_px - 20, kHeight_px), 4.0) << "300 m away: tufts";
}

TEST_F(RendererTest, DistantDetailDoesNotSparkle) {
    RENDERER_OR_SKIP(renderer, kWidth_px, kHeight_px);
    paint_ground(renderer);
    Scene scene = ground(600, 10, 0);
    const double third_of_pixel_rad = view_from(1.0, 0.0).fov_y_rad / kHeight_px / 3.0;
    const auto flicker = [&](double height_m) {
        const auto here = picture(view_from(height_m, 0.2), scene, renderer, 300);
        const auto there = picture(view_from(height_m, 0.2 + third_of_pixel_rad), scene, renderer, 300);
        return difference(here, there, kHeight_px / 3, kHeight_px);
    };
    const double plain_low = flicker(60.0), plain_high = flicker(2500.0);
    renderer.set_detail(kDetail);
    EXPECT_LT(flicker(60.0), plain_low + 2.5)
        << "near by a shift moves what is seen, by less than the structure";
    EXPECT_LT(flicker(2500.0), plain_high + 0.35) << "from high above nothing is left to move";
}

TEST_F(RendererTest, DetailDoesNotDependOnHowTheGroundIsCut) {
    RENDERER_OR_SKIP(renderer, kWidth_px, kHeight_px);
    paint_ground(renderer);
    renderer.set_detail(kDetail);
    Scene coarse = ground(64, 1, 0), fine = ground(64, 16, 0);
    const lod::View view = view_from(30.0, 0.5);
    const auto a = picture(view, coarse, renderer, 32), b = picture(view, fine, renderer, 32);
    EXPECT_LT(difference(a, b, 0, kHeight_px), 0.05);
}

TEST_F(RendererTest, DetailIsAsSharpAtTheGridsEndAsAtItsBeginning) {
    RENDERER_OR_SKIP(renderer, kWidth_px, kHeight_px);
    paint_ground(renderer);
    renderer.set_detail(kDetail);  // a sample is a tile: all samples look alike
    const lod::View view = view_from(4.0, 0.6);
    Scene near = ground(64, 8, 0);
    const auto a = picture(view, near, renderer, 32);
    for (const int far : {60'000, 1'296'000}) {  // the last: an arc second around the Earth
        Scene there = ground(64, 8, far);
        EXPECT_LT(difference(a, picture(view, there, renderer, far + 32), 0, kHeight_px), 0.02) << far;
        EXPECT_GT(difference(a, picture(view, there, renderer, 0), 0, kHeight_px), 0.1)
            << "the test sees lost digits";
    }
}

/// A wall of 24 x 24 m facing the eye, last index at its upper left corner as objects::BuildingMesh has it.
Scene wall(double distance_m, double left_m) {
    Scene scene;
    const Paint paint{.colour = {220, 210, 190}, .material = Material::kWall, .normal = {0, -1, 0}};
    const glm::dvec3 low_left(left_m, distance_m, -12.0), low_right(left_m + 24.0, distance_m, -12.0);
    const glm::dvec3 up(0.0, 0.0, 24.0);
    add_triangle({low_left, low_right, low_left + up}, paint, scene);
    add_triangle({low_right, low_right + up, low_left + up}, paint, scene);
    return scene;
}

lod::View facing_view() {
    return lod::look_at({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, view_of_size(kWidth_px, kHeight_px));
}

/// The wall's own pixels of a column, from the top.
std::vector<int> column(const render::ColourImage& image, int x) {
    std::vector<int> greens;
    for (int y = 0; y < kHeight_px; ++y) {
        if (pixel(image, x, y) != 0xff00ffu) greens.push_back(channel(image, x, y, 1));
    }
    return greens;
}

TEST_F(RendererTest, WallsHaveAFloorOfWindowsEveryThreeMetres) {
    RENDERER_OR_SKIP(renderer, kWidth_px, kHeight_px);
    renderer.set_detail(kDetail);
    Scene scene = wall(24.0, -12.0);
    const auto image = picture(facing_view(), scene, renderer, 0);
    std::vector<int> darkest = column(image, kWidth_px / 2);  // of each row: some windows have curtains
    for (int x = kWidth_px / 2 - 60; x <= kWidth_px / 2 + 60; ++x) {
        const std::vector<int> greens = column(image, x);
        ASSERT_EQ(greens.size(), darkest.size());
        for (size_t y = 0; y < greens.size(); ++y)
            darkest[y] = std::min(darkest[y], greens[y]);
    }
    const auto [dark, bright] = std::minmax_element(darkest.begin(), darkest.end());
    ASSERT_GT(*bright, *dark + 40);
    const int middle = (*bright + *dark) / 2;
    int floors = 0;
    for (size_t i = 1; i < darkest.size(); ++i)
        floors += darkest[i - 1] >= middle && darkest[i] < middle;
    EXPECT_EQ(floors, 8);
    EXPECT_GT(darkest.front(), middle) << "wall above the highest windows";
}

TEST_F(RendererTest, WindowsBelowTwoPixelsAreOneColour) {
    RENDERER_OR_SKIP(renderer, kWidth_px, kHeight_px);
    renderer.set_detail(kDetail);
    Scene near_wall = wall(24.0, -12.0), far_wall = wall(1200.0, -12.0);
    const auto near = picture(facing_view(), near_wall, renderer, 0);
    const auto far = picture(facing_view(), far_wall, renderer, 0);
    double mean = 0.0;
    int count = 0;
    for (int x = 0; x < kWidth_px; ++x) {
        for (const int green : column(near, x)) {
            mean += green;
            ++count;
        }
    }
    mean /= count;
    const std::vector<int> greens = column(far, kWidth_px / 2);
    ASSERT_GE(greens.size(), 2u);
    for (const int green : greens)
        EXPECT_NEAR(green, mean, 12.0);
}

TEST(SurfacePattern, GroundAndRoofAreNeutralInTheMeanAndTileWithoutASeam) {
    for (const render::Pattern pattern : {render::Pattern::kGround, render::Pattern::kRoof}) {
        const auto factors = render::paint_pattern(pattern, {0.8f, 0.0f, 0.6f});
        const size_t side = render::kPatternSide_px;
        ASSERT_EQ(factors.size(), side * side);
        float inside = 0.0f, seam = 0.0f;
        for (size_t y = 0; y < side; ++y) {
            const glm::vec3* row = &factors[y * side];
            inside += std::abs(row[200].y - row[201].y);
            seam += std::abs(row[side - 1].y - row[0].y);
        }
        EXPECT_LT(seam, 1.3f * inside);

        std::vector<glm::vec3> level = factors;
        for (int px = render::kPatternSide_px; px > 1; px /= 2)
            level = render::halved(level, px);
        ASSERT_EQ(level.size(), 1u);
        EXPECT_EQ(render::encode_factors(level),
                  (std::vector<uint8_t>{render::kNeutral, render::kNeutral, render::kNeutral, 255}));
    }
}

}  // namespace
