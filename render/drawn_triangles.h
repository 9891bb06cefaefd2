// From the GPU's own buffers back to triangles in the world. Pure: it sees plain arrays.
#pragma once

#include <span>

#include "lod/draw_list.h"
#include "lod/view.h"
#include "render/draw_command.h"
#include "render/renderer.h"

namespace render {

/// What a draw left in its buffers. Whole arrays, as the commands address them.
struct DrawnBuffers {
    std::span<const DrawCommand> commands;
    std::span<const lod::Instance> instances;
    std::span<const lod::Vertex> vertices;
    std::span<const uint32_t> indices;
};

/// Every triangle the commands draw, in their order; the sky is left out, and what names a vertex twice. Positions of world instances are
/// hi + lo exactly; others pass through the instance's float matrix. Wall feet are lowered as the shader does.
/// @param view  the view that was drawn
DrawnTriangles triangles_of(const DrawnBuffers& buffers, const lod::View& view);

}  // namespace render
