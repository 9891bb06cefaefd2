// FrameBlock: the numbers that all vertices and fragments of one frame share; std140, read by render/shaders.
#pragma once

#include <array>
#include <cstddef>

#include "lod/view.h"
#include "render/renderer.h"

namespace render {

/// Laid out as a GLSL vec4.
using Vec4 = std::array<float, 4>;

/// 128 bytes. Directions in the eye frame, unit length.
struct FrameBlock {
    Vec4 projection{};    ///< clip x and y per slope, near [m], metres per pixel at depth 1 (1/lambda)
    Vec4 ray{};           ///< a pixel's ray is (pixel.xy * ray.xy + ray.zw, -1), length free
    Vec4 sun_eye{};       ///< w: cosine of the sun disc's radius
    Vec4 up_eye{};        ///< w: clip coordinate of the picture's right and upper edge
    Vec4 haze{};          ///< extinction at the datum [octaves/m], thinning with height [octaves/m], thinning
                          ///< from the datum to the eye [octaves], density at the eye relative to the datum
    Vec4 ground_tiles{};  ///< a sample's place in tiles of the ground's pattern is (sample - zw) * xy + …
    Vec4 ground_phase{};  ///< … xy; zw unused
    Vec4 ground_grid{};   ///< its place in the ground texture is that * xy + zw
};
static_assert(sizeof(FrameBlock) == 128 && offsetof(FrameBlock, sun_eye) == 32 &&
              offsetof(FrameBlock, haze) == 64);

/// How ground texture and pattern lie on the samples.
struct Ground {
    int grid_width = 1, grid_height = 1;  ///< samples the texture spans
    double lead = 0.5;                    ///< of them before the first
    SurfaceDetail detail;
};

/// Fills the block for one view. No state; the projection itself is z_clip = near, w_clip = depth, so that
/// depth in the buffer is near/depth: 1 at the near plane, 0 at infinity.
/// @param guard_ratio  of the viewport (render/guard_band.h)
FrameBlock frame_block_of(const lod::View& view, const Atmosphere& atmosphere, const Ground& ground,
                          int guard_ratio);

}  // namespace render
