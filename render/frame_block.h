// FrameBlock: the numbers that all vertices and fragments of one frame share; std140, read by render/shaders.
#pragma once

#include <array>
#include <cstddef>

#include "lod/view.h"
#include "render/renderer.h"

namespace render {

/// 96 bytes, every member a vec4. Directions in the eye frame, unit length.
struct FrameBlock {
    std::array<float, 4>
        projection{};                ///< 1/tan_x, 1/tan_y, near [m], metres per pixel at depth 1 (1/lambda)
    std::array<float, 4> ray{};      ///< a pixel's ray is (pixel.xy * ray.xy + ray.zw, -1), length free
    std::array<float, 4> sun_eye{};  ///< w: cosine of the sun disc's radius
    std::array<float, 4> up_eye{};   ///< w unused
    std::array<float, 4> haze{};     ///< see mean_haze in shaders/scene.vert: extinction at the datum [octaves/m],
                                     ///< thinning with height [octaves/m], thinning up to the eye [octaves],
                                     ///< density at the eye relative to the datum
    std::array<float, 4> ground_grid{};  ///< 1/grid_width, 1/grid_height, unused, unused
};
static_assert(sizeof(FrameBlock) == 96 && offsetof(FrameBlock, sun_eye) == 32 &&
              offsetof(FrameBlock, haze) == 64);

/// Fills the block for one view. No state; the projection itself is z_clip = near, w_clip = depth, so that
/// depth in the buffer is near/depth: 1 at the near plane, 0 at infinity.
FrameBlock frame_block_of(const lod::View& view, const Atmosphere& atmosphere, int grid_width,
                          int grid_height);

}  // namespace render
