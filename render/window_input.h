// What keys and mouse mean. No window here: tests feed it.
//
//   W S, A D, PageUp PageDown   forward back, left right, up down
//   arrows, Q E                 yaw and pitch, roll
//   + -, space, Esc             faster slower, pause, close
//   . , R                       schedule twice, half as fast, backwards
//   Home End                    schedule to its begin, its end
//   drag with left or right     look around
#pragma once

#include <functional>

#include "render/renderer.h"

namespace render {

/// The input that the held keys stand for; opposite keys cancel. What counts once is the
/// key's state, not its edge: see take_edges.
/// @param is_down  GLFW key code -> held or not
Renderer::Input input_of_keys(const std::function<bool(int)>& is_down);

/// Of what counts once, leaves what `before` does not have; `before` becomes what was held now.
void take_edges(Renderer::Input& input, Renderer::Input& before);

/// Adds a drag of the mouse since the last poll to yaw and pitch; the sums stay in [-1, 1]. The view follows the
/// pointer: right is yaw to the right, up is pitch up.
/// @param x_px, y_px  to the right and down
void add_drag(double x_px, double y_px, Renderer::Input& input);

}  // namespace render
