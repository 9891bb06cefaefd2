#include "render/pattern_texture.h"

#include <array>
#include <bit>

#include "render/surface_pattern.h"

namespace render {

namespace {

TextureArray make_array(int side_px) {
    TextureArray texture = TextureArray::create();
    const auto levels = static_cast<GLsizei>(std::bit_width(static_cast<unsigned>(side_px)));
    glTextureStorage3D(texture.id(), levels, GL_RGBA8, side_px, side_px, kPatternCount);
    glTextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_T, GL_REPEAT);
    return texture;
}

/// All levels, averaged before they are rounded: a driver's own chain would darken from level to level.
void fill_layer(const TextureArray& texture, int layer, std::vector<glm::vec3> factors) {
    int side_px = kPatternSide_px;
    for (GLint level = 0; side_px > 0; ++level, side_px /= 2) {
        const std::vector<uint8_t> rgba = encode_factors(factors);
        glTextureSubImage3D(texture.id(), level, 0, 0, layer, side_px, side_px, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                            rgba.data());
        factors = halved(factors, side_px);
    }
}

}  // namespace

TextureArray make_plain_patterns() {
    TextureArray texture = make_array(1);
    constexpr std::array<uint8_t, 4> kPlain{kNeutral, kNeutral, kNeutral, 255};
    glClearTexImage(texture.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, kPlain.data());
    glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    return texture;
}

TextureArray make_patterns(const SurfaceDetail& detail, bool is_software) {
    TextureArray texture = make_array(kPatternSide_px);
    for (int layer = 0; layer < kPatternCount; ++layer)
        fill_layer(texture, layer, paint_pattern(static_cast<Pattern>(layer), glm::vec3(detail.sun_enu)));
    glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER,
                        is_software ? GL_LINEAR_MIPMAP_NEAREST : GL_LINEAR_MIPMAP_LINEAR);
    if (!is_software && epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) {
        glTextureParameterf(texture.id(), GL_TEXTURE_MAX_ANISOTROPY_EXT, 8.0f);
    }
    return texture;
}

}  // namespace render
