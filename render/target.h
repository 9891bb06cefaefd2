// Target: the picture being drawn, 8-bit colour and 32-bit float depth, and its way back to the CPU.
#pragma once

#include "lod/base/result.h"
#include "render/gl_handle.h"
#include "render/renderer.h"

namespace render {

struct Target {
    Framebuffer framebuffer;
    Renderbuffer colour;  ///< RGBA8, display values
    Renderbuffer depth;   ///< D32F, near/depth: 1 at the near plane, 0 at infinity
    int width_px = 0, height_px = 0;
};

/// Fails when the driver does not take the size.
lod::Result<Target> make_target(int width_px, int height_px);

/// Waits for the draws into the target.
ColourImage read_colour(const Target& target);

/// Waits for the draws into the target; linear metres.
/// @param near_m  of the view that was drawn
DepthImage read_depth(const Target& target, double near_m);

}  // namespace render
