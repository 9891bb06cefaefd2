// The scene's shader program, compiled from render/shaders and checked against the C++ records it reads.
#pragma once

#include "lod/base/result.h"
#include "render/gl_handle.h"

namespace render {

/// Compiles and links. Fails with the driver's first complaint, or when the driver lays a record out differently
/// from lod::Instance or FrameBlock.
lod::Result<Program> make_scene_program();

}  // namespace render
