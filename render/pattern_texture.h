// The surface patterns as one mipmapped array texture.
#pragma once

#include "render/gl_handle.h"
#include "render/renderer.h"

namespace render {

/// One neutral texel per layer: surfaces keep their colour.
TextureArray make_plain_patterns();

/// All patterns, painted anew. Cost: about 0.2 s.
/// @param is_software  a software rasteriser: cheap filter; else trilinear and anisotropic
TextureArray make_patterns(const SurfaceDetail& detail, bool is_software);

}  // namespace render
