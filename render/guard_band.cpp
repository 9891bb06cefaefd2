#include "render/guard_band.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>

namespace render {

int guard_ratio(int width_px, int height_px) {
    std::array<GLint, 2> largest{};
    std::array<GLfloat, 2> bounds{};
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, largest.data());
    glGetFloatv(GL_VIEWPORT_BOUNDS_RANGE, bounds.data());
    for (const int ratio : {4, 2}) {
        const bool has_size = ratio * width_px <= largest[0] && ratio * height_px <= largest[1];
        const auto reach = static_cast<float>((ratio + 1) * std::max(width_px, height_px)) / 2.0f;
        if (has_size && -reach >= bounds[0] && reach <= bounds[1]) return ratio;
    }
    return 1;
}

void set_viewport(int width_px, int height_px, int ratio) {
    const auto width = static_cast<float>(width_px), height = static_cast<float>(height_px),
               scale = static_cast<float>(ratio);
    const float before = -0.5f * (scale - 1.0f);
    glViewportIndexedf(0, before * width, before * height, scale * width, scale * height);
}

}  // namespace render
