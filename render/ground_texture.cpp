#include "render/ground_texture.h"

#include <algorithm>
#include <bit>
#include <string>

#include "lod/base/check.h"

namespace render {

namespace {

/// Levels finer than the footprint of a pixel asks for: the ground is mostly seen at a slant. Set here and not in the
/// shader, where a software rasteriser would choose a level for every pixel instead of every four.
constexpr float kLevelBias = -0.6f;

void set_filter(GLuint texture, bool is_software) {
    glTextureParameterf(texture, GL_TEXTURE_LOD_BIAS, kLevelBias);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER,
                        is_software ? GL_LINEAR_MIPMAP_NEAREST : GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    if (!is_software && epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) {
        glTextureParameterf(texture, GL_TEXTURE_MAX_ANISOTROPY_EXT, 8.0f);
    }
}

}  // namespace

lod::Result<Texture2D> make_ground_texture(int width, int height, std::span<const uint8_t> rgba,
                                           bool is_software) {
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    if (width < 1 || height < 1 || width > limit || height > limit) {
        return lod::Error{"ground texture of " + size + " texels, expected 1x1 to " + std::to_string(limit) +
                          "x" + std::to_string(limit)};
    }
    const size_t expected_bytes = static_cast<size_t>(width) * static_cast<size_t>(height) * 4;
    if (rgba.size() != expected_bytes) {
        return lod::Error{"ground texture of " + size + " texels has " + std::to_string(rgba.size()) +
                          " bytes, expected " + std::to_string(expected_bytes)};
    }
    const auto levels = static_cast<GLsizei>(std::bit_width(static_cast<unsigned>(std::max(width, height))));
    Texture2D texture = Texture2D::create();
    glTextureStorage2D(texture.id(), levels, GL_RGBA8, width, height);
    glTextureSubImage2D(texture.id(), 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    GLint number = 0;
    for (const MipLevel& level : make_mip_levels(width, height, rgba)) {
        glTextureSubImage2D(texture.id(), ++number, 0, 0, level.width, level.height, GL_RGBA,
                            GL_UNSIGNED_BYTE, level.rgba.data());
    }
    set_filter(texture.id(), is_software);
    return texture;
}

void write_texels(const Texture2D& texture, const TexelPatch& patch) {
    if (patch.width == 0 || patch.height == 0) return;
    GLint width = 0, height = 0;
    glGetTextureLevelParameteriv(texture.id(), patch.level, GL_TEXTURE_WIDTH, &width);
    glGetTextureLevelParameteriv(texture.id(), patch.level, GL_TEXTURE_HEIGHT, &height);
    CHECK(patch.x >= 0 && patch.y >= 0 && patch.x + patch.width <= width && patch.y + patch.height <= height);
    CHECK(patch.rgba.size() == static_cast<size_t>(patch.width) * static_cast<size_t>(patch.height) * 4);
    glTextureSubImage2D(texture.id(), patch.level, patch.x, patch.y, patch.width, patch.height, GL_RGBA,
                        GL_UNSIGNED_BYTE, patch.rgba.data());
}

}  // namespace render
