// The ground's colour as a mipmapped texture.
#pragma once

#include <span>

#include "lod/base/result.h"
#include "render/gl_handle.h"
#include "render/mip_levels.h"

namespace render {

/// @param rgba        width * height * 4, row-major from the north-west, display values
/// @param is_software  a software rasteriser: cheap filter; else trilinear and anisotropic
/// Fails when the size does not match or exceeds what the driver takes.
lod::Result<Texture2D> make_ground_texture(int width, int height, std::span<const uint8_t> rgba,
                                           bool is_software);

/// Replaces some texels. CHECKs that they lie in the texture.
void write_texels(const Texture2D& texture, const TexelPatch& patch);

}  // namespace render
