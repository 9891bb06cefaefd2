// The numbers the renderer stands on: positions in ECEF to a small part of a pixel, depth without z-fighting.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/scene_kit.h"

namespace {

using namespace render_test;

constexpr double kDegree = 0.017453292519943295;

/// A view from a place on a sphere of `radius_m`, 3/4 level and turned, as a cockpit would have it.
lod::View view_at(double latitude_deg, double longitude_deg, double radius_m, const lod::View& optics) {
    const double p = latitude_deg * kDegree, l = longitude_deg * kDegree;
    const glm::dvec3 up(std::cos(p) * std::cos(l), std::cos(p) * std::sin(l), std::sin(p));
    const glm::dvec3 east(-std::sin(l), std::cos(l), 0.0);
    const glm::dvec3 north = glm::cross(up, east);
    lod::View view = optics;
    view.eye_world = up * radius_m + east * 0.123456 + north * 7.654321;
    view.eye_from_world = lod::eye_from_attitude(glm::dmat3(east, north, up), 0.7, -0.3, 0.2);
    return view;
}

struct Place {
    double latitude_deg, longitude_deg, radius_m;
};
constexpr std::array kPlaces{
    Place{0, 0, 6378137.0},         Place{45, 90, 6367489.5},       Place{-45, -179.9999, 6367489.5},
    Place{89.9999, 180, 6356752.3}, Place{-89.9999, 12, 6356352.3}, Place{43.7, 7.4, 6478137.0},
};

/// shaders/scene.vert in float arithmetic: picture coordinates in pixels.
glm::dvec2 float_twin_px(const lod::View& view, const lod::Vertex& v, const lod::Instance& at) {
    float near_eye[3];
    for (int i = 0; i < 3; ++i) {
        near_eye[i] = (v.position_hi[i] - at.origin_hi[i]) + (v.position_lo[i] - at.origin_lo[i]);
    }
    float eye[3];
    for (int row = 0; row < 3; ++row) {
        const auto& m = at.eye_from_model[row];
        eye[row] = m[0] * near_eye[0] + m[1] * near_eye[1] + m[2] * near_eye[2];
    }
    const auto scale = static_cast<float>(view.height_px / (2.0 * std::tan(view.fov_y_rad / 2.0)));
    return {view.width_px / 2.0 - double(scale * eye[0] / eye[2]),
            view.height_px / 2.0 + double(scale * eye[1] / eye[2])};
}

TEST(Precision, FloatTwinIsWithinATwentiethOfAPixelAtOneMetreInEcef) {
    double worst_px = 0, worst_without_low_px = 0;
    for (const Place& place : kPlaces) {
        lod::View view =
            view_at(place.latitude_deg, place.longitude_deg, place.radius_m, view_of_size(1920, 1080));
        for (int frame = 0; frame < 600; ++frame) {
            view.eye_world += glm::dvec3(1.1e-4, -0.7e-4, 0.9e-4);
            const glm::dvec3 in_eye(0.6 * std::sin(frame * 0.1), 0.4 * std::cos(frame * 0.17), -1.0);
            const glm::dvec3 world = view.eye_world + glm::transpose(view.eye_from_world) * in_eye;
            auto vertex = lod::make_vertex(world, {0, 0, 1}, {1, 1, 1}, lod::Material::kGlow);
            auto instance =
                lod::make_world_instance(view.eye_world, view.eye_from_world, lod::Module::kInstruments);
            const glm::dvec2 exact(project(view, world));
            worst_px = std::max(worst_px, glm::length(float_twin_px(view, vertex, instance) - exact));
            for (float& low : vertex.position_lo)
                low = 0.0f;
            for (float& low : instance.origin_lo)
                low = 0.0f;
            worst_without_low_px =
                std::max(worst_without_low_px, glm::length(float_twin_px(view, vertex, instance) - exact));
        }
    }
    EXPECT_LE(worst_px, 0.05);
    EXPECT_GT(worst_without_low_px, 10.0) << "the low parts must matter, or this test proves nothing";
}

/// Pixels of a quad 1 m ahead, its sides slightly slanted so that every row cuts them at another part of a pixel,
/// that differ from the projection in double, not counting those within 0.05 px of a side.
int wrong_pixels(const lod::View& view, bool keep_low_parts, render::Renderer& renderer) {
    std::array<glm::dvec3, 4> corners = rectangle(view, {-400, -300}, {400, 300}, 1.0);
    const double tilt_m = 9.0 / lod::metric_of(view).lambda_px;
    corners[2] += glm::transpose(view.eye_from_world) * glm::dvec3(tilt_m, tilt_m, 0.0);
    Scene scene;
    add_quad(corners, {.colour = {255, 255, 255}}, scene);
    prepare(view, scene);
    if (!keep_low_parts) {
        for (lod::Vertex& vertex : scene.vertices)
            std::fill_n(vertex.position_lo, 3, 0.0f);
        std::fill_n(scene.list.instances[0].origin_lo, 3, 0.0f);
    }
    renderer.draw(view, scene.list, vacuum());
    const auto colour = renderer.read_colour();

    std::array<glm::dvec3, 4> p;
    for (size_t i = 0; i < 4; ++i)
        p[i] = project(view, corners[i]);
    int wrong = 0;
    for (int y = 0; y < view.height_px; ++y) {
        for (int x = 0; x < view.width_px; ++x) {
            double inside_px = 1e9;
            for (size_t i = 0; i < 4; ++i) {
                const glm::dvec2 a(p[i]), b(p[(i + 1) % 4]), along = glm::normalize(b - a);
                const glm::dvec2 to(x + 0.5 - a.x, y + 0.5 - a.y);
                inside_px = std::min(inside_px, along.y * to.x - along.x * to.y);
            }
            if (std::abs(inside_px) < 0.05) continue;
            wrong += (pixel(colour, x, y) == 0xffffffu) != (inside_px > 0);
        }
    }
    return wrong;
}

TEST_F(RendererTest, RenderedEdgesAreWithinATwentiethOfAPixelInEcef) {
    RENDERER_OR_SKIP(renderer, 1920, 1080);
    for (const Place& place : kPlaces) {
        const lod::View view =
            view_at(place.latitude_deg, place.longitude_deg, place.radius_m, view_of_size(1920, 1080));
        EXPECT_EQ(wrong_pixels(view, true, renderer), 0) << place.latitude_deg << ", " << place.longitude_deg;
    }
    const lod::View view = view_at(45, 90, 6367489.5, view_of_size(1920, 1080));
    EXPECT_GT(wrong_pixels(view, false, renderer), 0) << "the low parts must matter";
}

/// A parallelogram across the line of sight, leaning back; `offset_m` further away.
std::array<glm::dvec3, 4> leaning_quad(const lod::View& view, double depth_m, double offset_m) {
    auto corners = rectangle(view, {-60, -30}, {60, 30}, depth_m);
    const glm::dvec3 ahead = -glm::transpose(view.eye_from_world)[2];
    for (size_t i = 0; i < 4; ++i)
        corners[i] += ahead * (offset_m + (i >= 2 ? 0.05 * depth_m : 0.0));
    return corners;
}

TEST_F(RendererTest, ParallelSurfacesDoNotFight) {
    RENDERER_OR_SKIP(renderer, 160, 90);
    lod::View view = view_at(43.7, 7.4, 6368000.0, view_of_size(160, 90));
    struct Case {
        double depth_m, gap_m;
    };
    for (const Case& c : {Case{1000.0, 0.01}, Case{10000.0, 0.1}}) {
        const double step = view.near_m / c.depth_m - view.near_m / (c.depth_m + c.gap_m);
        EXPECT_LT(step, 0x1p-24) << "a 24-bit buffer could not tell these apart";
        Scene scene;
        add_quad(leaning_quad(view, c.depth_m, 0.0), {.colour = {0, 255, 0}}, scene);
        add_quad(leaning_quad(view, c.depth_m, c.gap_m), {.colour = {255, 0, 0}}, scene);
        int seen = 0, flipped = 0;
        for (int frame = 0; frame < 300; ++frame) {
            view.eye_world += glm::transpose(view.eye_from_world) * glm::dvec3(0.03, 0.01, -0.02);
            draw(view, vacuum(), scene, renderer);
            const auto colour = renderer.read_colour();
            for (int y = 18; y < 72; ++y) {
                for (int x = 30; x < 130; ++x) {
                    seen += pixel(colour, x, y) == 0x00ff00u;
                    flipped += pixel(colour, x, y) == 0xff0000u;
                }
            }
        }
        EXPECT_GT(seen, 300 * 50 * 90);
        EXPECT_EQ(flipped, 0) << "at " << c.depth_m << " m";
    }
}

}  // namespace
