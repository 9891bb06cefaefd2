// Window: a GLFW window with an OpenGL 4.5 core context, its keys and its mouse.
#pragma once

#include <memory>
#include <string>

#include "lod/base/result.h"
#include "render/renderer.h"

struct GLFWwindow;

namespace render {

/// Current on the creating thread from creation to destruction; one at a time. Move-only.
class Window {
  public:
    /// Fails with one line when there is no display or no OpenGL 4.5.
    static lod::Result<Window> create(int width_px, int height_px, const std::string& title);

    /// Copies the colour of a framebuffer of the given size to the window, scaled to fill it, and swaps.
    void present(unsigned framebuffer, int width_px, int height_px);

    /// Handles pending events; what is held or happened since the last call.
    Renderer::Input poll();

  private:
    /// Closes the window and GLFW with it.
    struct Close {
        void operator()(GLFWwindow* window) const;
    };
    explicit Window(GLFWwindow* window) : window_(window) {}

    std::unique_ptr<GLFWwindow, Close> window_;
    double cursor_x_px_ = 0, cursor_y_px_ = 0;
    Renderer::Input held_;  ///< at the last poll
};

}  // namespace render
