#include "render/target.h"

#include <algorithm>
#include <limits>
#include <string>

namespace render {

namespace {

/// OpenGL's first row is the lowest; a picture's first row is the top one.
template <typename T>
void flip_rows(std::vector<T>& pixels, int width, int height) {
    for (int top = 0, bottom = height - 1; top < bottom; ++top, --bottom) {
        const auto row = static_cast<std::ptrdiff_t>(width);
        std::swap_ranges(pixels.begin() + top * row, pixels.begin() + (top + 1) * row,
                         pixels.begin() + bottom * row);
    }
}

size_t pixel_count(const Target& target) {
    return static_cast<size_t>(target.width_px) * static_cast<size_t>(target.height_px);
}

}  // namespace

lod::Result<Target> make_target(int width_px, int height_px) {
    GLint limit_px = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &limit_px);
    const std::string size = std::to_string(width_px) + "x" + std::to_string(height_px);
    if (width_px < 1 || height_px < 1 || width_px > limit_px || height_px > limit_px) {
        return lod::Error{"picture of " + size + " pixels, expected 1x1 to " + std::to_string(limit_px) +
                          "x" + std::to_string(limit_px)};
    }
    Target target{Framebuffer::create(), Renderbuffer::create(), Renderbuffer::create(), width_px, height_px};
    glNamedRenderbufferStorage(target.colour.id(), GL_RGBA8, width_px, height_px);
    glNamedRenderbufferStorage(target.depth.id(), GL_DEPTH_COMPONENT32F, width_px, height_px);
    const GLuint id = target.framebuffer.id();
    glNamedFramebufferRenderbuffer(id, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target.colour.id());
    glNamedFramebufferRenderbuffer(id, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, target.depth.id());
    if (glCheckNamedFramebufferStatus(id, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return lod::Error{"the driver cannot draw into " + size + " RGBA8 with 32-bit float depth"};
    }
    return target;
}

ColourImage read_colour(const Target& target) {
    ColourImage image{target.width_px, target.height_px, {}};
    std::vector<uint32_t> pixels(pixel_count(target));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer.id());
    glReadPixels(0, 0, target.width_px, target.height_px, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    flip_rows(pixels, target.width_px, target.height_px);
    const auto* bytes = reinterpret_cast<const uint8_t*>(pixels.data());
    image.rgba.assign(bytes, bytes + pixels.size() * 4);
    return image;
}

DepthImage read_depth(const Target& target, double near_m) {
    DepthImage image{target.width_px, target.height_px, {}};
    image.depth_m.resize(pixel_count(target));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer.id());
    glReadPixels(0, 0, target.width_px, target.height_px, GL_DEPTH_COMPONENT, GL_FLOAT, image.depth_m.data());
    flip_rows(image.depth_m, target.width_px, target.height_px);
    for (float& depth : image.depth_m) {
        depth = depth > 0.0f ? static_cast<float>(near_m / static_cast<double>(depth))
                             : std::numeric_limits<float>::infinity();
    }
    return image;
}

}  // namespace render
