// The scene's shader program, compiled from render/shaders and checked against the C++ record it reads.
#pragma once

#include "lod/base/result.h"
#include "render/gl_handle.h"

namespace render {

/// Compiles and links. Fails with the driver's first complaint, or when the driver lays the frame's block
/// out differently from FrameBlock.
lod::Result<Program> make_scene_program();

}  // namespace render
