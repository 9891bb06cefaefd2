// Texture images decoded to pixels, from files and from memory.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "data/polygon_mesh.h"

namespace data {

/// PNG, JPEG, GIF, BMP, TIFF, WebP or SGI; grey, palette and 16-bit images become 8-bit RGBA. Empty when it is none of
/// these, damaged, or larger than 8192 pixels on a side.
std::optional<MeshTexture> read_texture(const std::string& path);
std::optional<MeshTexture> decode_texture(std::span<const uint8_t> bytes);

}  // namespace data
