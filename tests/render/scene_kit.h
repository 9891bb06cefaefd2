// Small scenes for the renderer's tests: one call from quads to a picture, and the projection in double precision
// that pictures are judged against.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "lod/draw_list.h"
#include "lod/view.h"
#include "render/renderer.h"

namespace render_test {

using render::vacuum;

/// Geometry and the list that draws it; `list` refers to `vertices` and `indices`.
struct Scene {
    std::vector<lod::Vertex> vertices;
    std::vector<uint32_t> indices;
    lod::DrawList list;
};

/// How a triangle looks.
struct Paint {
    glm::u8vec3 colour{255, 255, 255};
    lod::Material material = lod::Material::kGlow;
    glm::vec3 normal{0.0f, 0.0f, 1.0f};
    bool is_glass = false;
};

/// Adds a triangle as an item of its own, for instance 0.
inline void add_triangle(const std::array<glm::dvec3, 3>& corners, const Paint& paint, Scene& scene) {
    const auto first = static_cast<uint32_t>(scene.vertices.size());
    for (uint32_t i = 0; i < 3; ++i) {
        scene.vertices.push_back(lod::make_vertex(corners[i], paint.normal, paint.colour, paint.material));
        scene.indices.push_back(i);
    }
    scene.list.items.push_back(
        {.index_count = 3, .first_index = first, .base_vertex = int32_t(first), .is_glass = paint.is_glass});
}

/// Adds a quad, corners in order around it, as two triangles.
inline void add_quad(const std::array<glm::dvec3, 4>& c, const Paint& paint, Scene& scene) {
    add_triangle({c[0], c[1], c[2]}, paint, scene);
    add_triangle({c[0], c[2], c[3]}, paint, scene);
}

/// A rectangle across the line of sight, given in pixels from the picture's centre (right, up) at one depth.
inline std::array<glm::dvec3, 4> rectangle(const lod::View& view, glm::dvec2 low_px, glm::dvec2 high_px,
                                           double depth_m) {
    const double m_per_px = depth_m / lod::metric_of(view).lambda_px;
    const auto corner = [&](double x_px, double y_px) {
        return view.eye_world +
               glm::transpose(view.eye_from_world) * glm::dvec3(x_px * m_per_px, y_px * m_per_px, -depth_m);
    };
    return {corner(low_px.x, low_px.y), corner(high_px.x, low_px.y), corner(high_px.x, high_px.y),
            corner(low_px.x, high_px.y)};
}

/// Writes and the one world instance of `scene`, as seen by `view`.
inline void prepare(const lod::View& view, Scene& scene) {
    if (scene.list.instances.empty()) scene.list.instances.resize(1);
    scene.list.instances[0] =
        lod::make_world_instance(view.eye_world, view.eye_from_world, lod::Module::kTerrain);
    scene.list.vertex_writes = {{0, scene.vertices}};
    scene.list.index_writes = {{0, scene.indices}};
}

inline void draw(const lod::View& view, const render::Atmosphere& atmosphere, Scene& scene,
                 render::Renderer& renderer) {
    prepare(view, scene);
    renderer.draw(view, scene.list, atmosphere);
    renderer.finish();
}

/// Picture coordinates (pixels from the left and top edge, pixel centres at +0.5) and depth, in double.
inline glm::dvec3 project(const lod::View& view, const glm::dvec3& world) {
    const glm::dvec3 eye = view.eye_from_world * (world - view.eye_world);
    const double lambda_px = view.height_px / (2.0 * std::tan(view.fov_y_rad / 2.0));
    return {view.width_px / 2.0 - lambda_px * eye.x / eye.z, view.height_px / 2.0 + lambda_px * eye.y / eye.z,
            -eye.z};
}

/// Red, green, blue of a pixel as 0xRRGGBB.
inline uint32_t pixel(const render::ColourImage& image, int x, int y) {
    const size_t i = (static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x)) * 4;
    return (uint32_t{image.rgba[i]} << 16) | (uint32_t{image.rgba[i + 1]} << 8) | image.rgba[i + 2];
}
inline int channel(const render::ColourImage& image, int x, int y, int which) {
    return static_cast<int>((pixel(image, x, y) >> (16 - 8 * which)) & 0xff);
}
inline float depth_at(const render::DepthImage& image, int x, int y) {
    return image.depth_m[static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x)];
}

inline lod::View view_of_size(int width_px, int height_px) {
    lod::View view;
    view.width_px = width_px;
    view.height_px = height_px;
    view.fov_y_rad = 1.0471975511965976;
    return view;
}

/// A fixture with a renderer per test; skipped where no OpenGL 4.5 can be had.
class RendererTest : public testing::Test {
  protected:
    /// The renderer, or nothing after a skip.
    render::Renderer* make(int width_px, int height_px, uint32_t commands = 64) {
        render::RendererOptions options;
        options.width_px = width_px;
        options.height_px = height_px;
        options.pool = {.vertices = 4096, .indices = 8192, .commands = commands};
        auto created = render::Renderer::create(options);
        if (!created) {
            skip_reason_ = created.message();
            return nullptr;
        }
        renderer_.emplace(std::move(*created));
        return &*renderer_;
    }
    std::optional<render::Renderer> renderer_;
    std::string skip_reason_;
};

}  // namespace render_test

/// Declares `name`, a Renderer&, or skips the test.
#define RENDERER_OR_SKIP(name, ...)                           \
    render::Renderer* name##_made = make(__VA_ARGS__);        \
    if (name##_made == nullptr) GTEST_SKIP() << skip_reason_; \
    render::Renderer& name = *name##_made
