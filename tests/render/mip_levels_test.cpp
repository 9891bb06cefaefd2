// Smaller sizes of a picture: means of the area they stand for, and a part brought up to date is the whole made anew.
#include "render/mip_levels.h"

#include <algorithm>
#include <cmath>

#include "lod/base/rng.h"
#include "tests/render/scene_kit.h"

namespace {

using namespace render_test;

std::vector<uint8_t> noise(int width, int height, uint64_t seed) {
    lod::Rng rng(seed);
    std::vector<uint8_t> rgba(static_cast<size_t>(width * height * 4));
    for (uint8_t& value : rgba)
        value = static_cast<uint8_t>(rng.below(256));
    return rgba;
}

render::MippedPicture mipped(int width, int height, const std::vector<uint8_t>& rgba) {
    render::MippedPicture picture;
    picture.full.width = width;
    picture.full.height = height;
    picture.full.rgba = rgba;
    picture.smaller = render::make_mip_levels(width, height, rgba);
    return picture;
}

/// Mean of a channel over [x0, x1) x [y0, y1) of the picture, in parts of texels.
double area_mean(const std::vector<uint8_t>& rgba, int width, const std::array<double, 4>& area,
                 int channel) {
    const auto [x0, x1, y0, y1] = area;
    double sum = 0.0;
    for (int y = static_cast<int>(y0); y < y1; ++y) {
        for (int x = static_cast<int>(x0); x < x1; ++x) {
            const double share = (std::min(x + 1.0, x1) - std::max<double>(x, x0)) *
                                 (std::min(y + 1.0, y1) - std::max<double>(y, y0));
            sum += share * rgba[static_cast<size_t>((y * width + x) * 4 + channel)];
        }
    }
    return sum / ((x1 - x0) * (y1 - y0));
}

TEST(MipLevels, AreMeansOfTheirArea) {
    for (const auto& [width, height] : {std::pair{64, 32}, std::pair{37, 50}, std::pair{5, 1}}) {
        const std::vector<uint8_t> rgba = noise(width, height, 3);
        const auto levels = render::make_mip_levels(width, height, rgba);
        EXPECT_EQ(levels.back().width * levels.back().height, 1);
        render::MipLevel finer = mipped(width, height, rgba).full;
        for (const render::MipLevel& level : levels) {
            const double sx = double(finer.width) / level.width, sy = double(finer.height) / level.height;
            for (int y = 0; y < level.height; ++y) {
                for (int x = 0; x < level.width; ++x) {
                    const double mean =
                        area_mean(finer.rgba, finer.width, {x * sx, (x + 1) * sx, y * sy, (y + 1) * sy}, 1);
                    ASSERT_NEAR(level.rgba[static_cast<size_t>((y * level.width + x) * 4 + 1)], mean, 0.51)
                        << level.width << "x" << level.height << ": " << x << ", " << y;
                }
            }
            finer = level;
        }
    }
    EXPECT_TRUE(render::make_mip_levels(1, 1, noise(1, 1, 2)).empty());
}

TEST(MipLevels, APartBroughtUpToDateIsTheWholeMadeAnew) {
    lod::Rng rng(9);
    const auto below = [&](int n) { return static_cast<int>(rng.below(uint64_t(n))); };
    for (int round = 0; round < 200; ++round) {
        const int width = 1 + below(70), height = 1 + below(70);
        const std::vector<uint8_t> before = noise(width, height, uint64_t(round));
        render::MippedPicture picture = mipped(width, height, before);
        render::TexelPatch rect{0, below(width), below(height), 0, 0, {}};
        rect.width = 1 + below(width - rect.x);
        rect.height = 1 + below(height - rect.y);
        for (int y = rect.y; y < rect.y + rect.height; ++y) {
            for (int x = rect.x * 4; x < (rect.x + rect.width) * 4; ++x)
                picture.full.rgba[static_cast<size_t>(y * width * 4 + x)] = static_cast<uint8_t>(below(256));
        }
        const auto patches = render::update_mip_levels(picture, rect);
        const auto anew = render::make_mip_levels(width, height, picture.full.rgba);
        ASSERT_EQ(patches.size(), anew.size() + 1);
        for (size_t i = 0; i < anew.size(); ++i) {
            ASSERT_EQ(picture.smaller[i].rgba, anew[i].rgba) << width << "x" << height << " level " << i + 1;
            const render::TexelPatch& patch = patches[i + 1];
            ASSERT_EQ(patch.rgba.size(), static_cast<size_t>(patch.width * patch.height * 4));
            ASSERT_LE(patch.width * patch.height, rect.width * rect.height + 2 * (rect.width + rect.height));
        }
    }
}

/// A picture whose texels were replaced is drawn as one that had them from the start, at every size.
TEST_F(RendererTest, ReplacedTexelsAreDrawn) {
    RENDERER_OR_SKIP(renderer, 96, 96);
    constexpr int kGrid = 65;
    const std::vector<uint8_t> before = noise(kGrid, kGrid, 1);
    render::MippedPicture picture = mipped(kGrid, kGrid, before);
    render::TexelPatch rect{0, 20, 25, 30, 17, {}};
    for (int y = rect.y; y < rect.y + rect.height; ++y) {
        for (int x = rect.x * 4; x < (rect.x + rect.width) * 4; ++x)
            picture.full.rgba[static_cast<size_t>(y * kGrid * 4 + x)] = 200;
    }
    const auto patches = render::update_mip_levels(picture, rect);
    const auto drawn = [&](double size_px) {
        const lod::View view = lod::look_at({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, view_of_size(96, 96));
        Scene scene;
        add_quad(rectangle(view, glm::dvec2(-size_px), glm::dvec2(size_px), 5.0),
                 {.material = lod::Material::kGround}, scene);
        const uint16_t last = kGrid - 1;
        const std::array<std::array<uint16_t, 2>, 6> sample{
            {{0, last}, {last, last}, {last, 0}, {0, last}, {last, 0}, {0, 0}}};
        for (size_t i = 0; i < 6; ++i) {
            scene.vertices[i].surface[0] = sample[i][0];
            scene.vertices[i].surface[1] = sample[i][1];
        }
        draw(view, vacuum(), scene, renderer);
        return renderer.read_colour().rgba;
    };
    for (const double size_px : {48.0, 20.0, 8.0, 3.0}) {
        ASSERT_TRUE(renderer.set_ground_texture(kGrid, kGrid, before, kGrid, kGrid));
        const auto was = drawn(size_px);
        renderer.write_ground_texels(patches);
        const auto replaced = drawn(size_px);
        ASSERT_TRUE(renderer.set_ground_texture(kGrid, kGrid, picture.full.rgba, kGrid, kGrid));
        EXPECT_EQ(replaced, drawn(size_px)) << size_px;
        EXPECT_NE(replaced, was) << size_px;
    }
}

}  // namespace
