// The scene's shader programs, compiled from render/shaders and checked against the C++ record it reads.
#pragma once

#include "lod/base/result.h"
#include "render/gl_handle.h"

namespace render {

/// What a scene may have; what it has not costs its shaders nothing.
struct ShaderFeatures {
    bool has_textures =
        false;             ///< the ground's colours and the patterns of surfaces; without: white and plain
    bool has_air = false;  ///< haze and sky
};

/// Compiles and links. Fails with the driver's first complaint, or when the driver lays the frame's block
/// out differently from FrameBlock.
lod::Result<Program> make_scene_program(const ShaderFeatures& features);

}  // namespace render
