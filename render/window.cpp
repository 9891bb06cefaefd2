#include "render/window.h"

#include <epoxy/gl.h>
// epoxy must come before GLFW, which would otherwise bring its own GL header.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

#include "render/window_input.h"

namespace render {

namespace {

/// GLFW's own words for the last failure.
std::string last_glfw_error() {
    const char* text = nullptr;
    return glfwGetError(&text) != GLFW_NO_ERROR && text != nullptr ? text : "unknown reason";
}

GLFWwindow* open_window(int width_px, int height_px, const char* title) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    return glfwCreateWindow(width_px, height_px, title, nullptr, nullptr);
}

}  // namespace

void Window::Close::operator()(GLFWwindow* window) const {
    glfwDestroyWindow(window);
    glfwTerminate();
}

lod::Result<Window> Window::create(int width_px, int height_px, const std::string& title) {
    if (glfwInit() != GLFW_TRUE) {
        return lod::Error{"no window system (" + last_glfw_error() +
                          "), expected a display, e.g. DISPLAY=:0"};
    }
    GLFWwindow* handle = open_window(width_px, height_px, title.c_str());
    if (handle == nullptr) {
        const std::string reason = last_glfw_error();
        glfwTerminate();
        return lod::Error{"no window with OpenGL 4.5 core (" + reason + "), expected a newer driver"};
    }
    Window window(handle);
    glfwMakeContextCurrent(handle);
    glfwSwapInterval(0);                                    // the frame loop keeps the rate
    glfwSetInputMode(handle, GLFW_STICKY_KEYS, GLFW_TRUE);  // a key tapped between two polls still counts
    glfwGetCursorPos(handle, &window.cursor_x_px_, &window.cursor_y_px_);
    return window;
}

void Window::present(unsigned framebuffer, int width_px, int height_px) {
    int window_width_px = 0, window_height_px = 0;
    glfwGetFramebufferSize(window_.get(), &window_width_px, &window_height_px);
    glBlitNamedFramebuffer(framebuffer, 0, 0, 0, width_px, height_px, 0, 0, window_width_px, window_height_px,
                           GL_COLOR_BUFFER_BIT, GL_LINEAR);
    glfwSwapBuffers(window_.get());
}

Renderer::Input Window::poll() {
    glfwPollEvents();
    const auto is_down = [this](int key) { return glfwGetKey(window_.get(), key) == GLFW_PRESS; };
    Renderer::Input input = input_of_keys(is_down);
    input.close = input.close || glfwWindowShouldClose(window_.get()) == GLFW_TRUE;
    take_edges(input, held_);

    double x_px = 0, y_px = 0;
    glfwGetCursorPos(window_.get(), &x_px, &y_px);
    const bool drags = glfwGetMouseButton(window_.get(), GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS ||
                       glfwGetMouseButton(window_.get(), GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS;
    if (drags) add_drag(x_px - cursor_x_px_, y_px - cursor_y_px_, input);
    cursor_x_px_ = x_px;
    cursor_y_px_ = y_px;
    return input;
}

}  // namespace render
