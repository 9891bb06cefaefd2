// The window needs a display; the ctest "render.window" runs these under Xvfb.

#include <gtest/gtest.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <set>

#include "render/window_input.h"
#include "tests/render/scene_kit.h"

namespace {

using namespace render_test;

render::Renderer::Input input_of(const std::set<int>& held) {
    return render::input_of_keys([&held](int key) { return held.contains(key); });
}

TEST(WindowInput, KeysMeanWhatTheHeaderSays) {
    EXPECT_EQ(input_of({GLFW_KEY_W}).forward, 1.0);
    EXPECT_EQ(input_of({GLFW_KEY_S}).forward, -1.0);
    EXPECT_EQ(input_of({GLFW_KEY_D}).right, 1.0);
    EXPECT_EQ(input_of({GLFW_KEY_A}).right, -1.0);
    EXPECT_EQ(input_of({GLFW_KEY_PAGE_UP}).up, 1.0);
    EXPECT_EQ(input_of({GLFW_KEY_PAGE_DOWN}).up, -1.0);
    EXPECT_EQ(input_of({GLFW_KEY_RIGHT}).yaw, 1.0);
    EXPECT_EQ(input_of({GLFW_KEY_LEFT}).yaw, -1.0);
    EXPECT_EQ(input_of({GLFW_KEY_UP}).pitch, 1.0);
    EXPECT_EQ(input_of({GLFW_KEY_DOWN}).pitch, -1.0);
    EXPECT_EQ(input_of({GLFW_KEY_E}).roll, 1.0);
    EXPECT_EQ(input_of({GLFW_KEY_Q}).roll, -1.0);
    EXPECT_TRUE(input_of({GLFW_KEY_ESCAPE}).close);
    EXPECT_TRUE(input_of({GLFW_KEY_SPACE}).pause);
    EXPECT_TRUE(input_of({GLFW_KEY_R}).schedule_reverse);
    EXPECT_TRUE(input_of({GLFW_KEY_HOME}).schedule_begin);
    EXPECT_TRUE(input_of({GLFW_KEY_EQUAL}).faster && input_of({GLFW_KEY_KP_ADD}).faster);
    EXPECT_TRUE(input_of({GLFW_KEY_MINUS}).slower && input_of({GLFW_KEY_KP_SUBTRACT}).slower);
    EXPECT_EQ(input_of({GLFW_KEY_W, GLFW_KEY_S}).forward, 0.0) << "opposite keys cancel";
}

TEST(WindowInput, DragsStayInRange) {
    render::Renderer::Input input;
    render::add_drag(10, -10, input);
    EXPECT_GT(input.yaw, 0.0) << "to the right";
    EXPECT_GT(input.pitch, 0.0) << "up";
    render::add_drag(1e6, 1e6, input);
    EXPECT_EQ(input.yaw, 1.0);
    EXPECT_EQ(input.pitch, -1.0);
}

bool has_display() {
    const bool has = glfwInit() == GLFW_TRUE;
    glfwTerminate();
    return has;
}

render::RendererOptions window_options(int width_px, int height_px) {
    render::RendererOptions options;
    options.width_px = width_px;
    options.height_px = height_px;
    options.window = true;
    options.pool = {.vertices = 64, .indices = 64, .commands = 16};
    return options;
}

TEST(Window, DrawsPresentsAndPolls) {
    if (!has_display()) GTEST_SKIP() << "no display; the ctest render.window brings one";
    auto renderer = render::Renderer::create(window_options(160, 90));
    ASSERT_TRUE(renderer) << renderer.message();
    const lod::View view = view_of_size(160, 90);
    Scene scene;
    add_quad(rectangle(view, {-10, -10}, {10, 10}, 3.0), {.colour = {1, 2, 3}}, scene);
    for (int frame = 0; frame < 5; ++frame) {
        draw(view, vacuum(), scene, *renderer);
        EXPECT_FALSE(renderer->poll_input().close);
        EXPECT_EQ(renderer->stats().draw_calls, 1u);
    }
    EXPECT_EQ(renderer->stats().allocations, 0u);
    EXPECT_EQ(pixel(renderer->read_colour(), 80, 45), 0x010203u);
    EXPECT_EQ(pixel(renderer->read_colour(), 2, 2), 0xff00ffu);
}

TEST(Window, GivesTheSamePictureAsNoWindow) {
    if (!has_display()) GTEST_SKIP() << "no display; the ctest render.window brings one";
    const lod::View view = view_of_size(160, 90);
    std::array<std::vector<uint8_t>, 2> pictures;
    for (const bool window : {false, true}) {
        render::RendererOptions options = window_options(160, 90);
        options.window = window;
        auto renderer = render::Renderer::create(options);
        ASSERT_TRUE(renderer) << renderer.message();
        Scene scene;
        add_quad(rectangle(view, {-30, -10}, {10, 20}, 3.0), {.material = lod::Material::kPaint}, scene);
        draw(view, render::Atmosphere{}, scene, *renderer);
        pictures[window ? 1 : 0] = renderer->read_colour().rgba;
    }
    EXPECT_EQ(pictures[0], pictures[1]);
}

TEST(Window, NoDisplayIsOneLine) {
    if (has_display()) GTEST_SKIP() << "there is a display";
    const auto renderer = render::Renderer::create(window_options(160, 90));
    ASSERT_FALSE(renderer);
    EXPECT_EQ(renderer.message().find('\n'), std::string::npos);
}

}  // namespace
