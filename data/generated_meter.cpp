#include "data/generated_meter.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "data/gauge_parts.h"
#include "data/solid.h"
#include "lod/base/check.h"

namespace data {

namespace {

constexpr double kMm = 0.001;

glm::dmat4 placed(const glm::dvec3& at) {
    glm::dmat4 matrix(1.0);
    matrix[3] = glm::dvec4(at, 1.0);
    return matrix;
}

void append_numbers(Gauge& gauge) {
    for (int i = 0; i < 20; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 20;
        const glm::dvec2 at = 29.5 * kMm * glm::dvec2(std::sin(angle), std::cos(angle));
        append_text(std::to_string(5 * i), {.middle = at, .height_m = 3.4 * kMm}, gauge.dial_node, gauge);
    }
}

/// A screw post with a nut-like foot, its thread in rings; it stands out behind the plate.
void append_terminal(const glm::dvec2& at, Gauge& gauge) {
    constexpr int kSegments = 96, kRings = 48;
    const uint32_t node = add_node(gauge.mesh, "terminal", 0, placed({at, -12.0 * kMm}));
    std::vector<glm::dvec2> profile{{0.0, 12.0 * kMm}, {1.6 * kMm, 12.0 * kMm}};
    for (int i = 0; i <= kRings; ++i) {
        const double along = static_cast<double>(i) / kRings;
        const double thread = 0.18 * kMm * std::cos(2.0 * std::numbers::pi * 12.0 * along);
        profile.emplace_back(2.0 * kMm + thread, (11.5 - 9.5 * along) * kMm);
    }
    profile.emplace_back(4.2 * kMm, 1.9 * kMm);
    profile.emplace_back(4.4 * kMm, 1.6 * kMm);
    profile.emplace_back(4.4 * kMm, 0.0);
    append_lathe(profile, kSegments, {.mesh = &gauge.mesh, .node = node, .material = gauge.material.steel});
}

/// The damper: a drum whose wall is ribbed all along, closed by a shallow cone, of exactly so many triangles.
void append_damper(uint32_t triangles, Gauge& gauge) {
    constexpr uint32_t kRings = 90;
    const uint32_t segments = (triangles - 3) / (2 * kRings), cone = triangles - 2 * kRings * segments;
    CHECK(segments >= 24 && cone >= 3);
    const uint32_t node = add_node(gauge.mesh, "damper", 0, placed({0.0, -22.0 * kMm, 1.0 * kMm}));
    const SolidTarget target{.mesh = &gauge.mesh, .node = node, .material = gauge.material.accent};
    std::vector<glm::dvec2> wall;
    for (uint32_t i = 0; i <= kRings; ++i) {
        const double along = static_cast<double>(i) / kRings;
        const double rib = 0.12 * kMm * std::sin(2.0 * std::numbers::pi * 9.0 * along);
        wall.emplace_back((5.0 + 0.8 * along) * kMm + rib, (3.0 - 3.0 * along) * kMm);
    }
    append_lathe(wall, static_cast<int>(segments), target);
    const std::array<glm::dvec2, 2> cap{glm::dvec2(0.0, 3.4 * kMm), wall.front()};
    append_lathe(cap, static_cast<int>(cone), target);
}

}  // namespace

PolygonMesh generate_meter(uint32_t triangles) {
    Gauge gauge = begin_gauge("meter");
    append_case(true, gauge);
    append_dial({}, gauge);
    append_ticks({.count = 200, .major_every = 10}, gauge.dial_node, gauge);
    append_ticks({.count = 100, .major_every = 5, .outer_m = 0.0255, .minor_m = 0.0012, .major_m = 0.0020},
                 gauge.dial_node, gauge);
    append_numbers(gauge);
    append_text("mA", {.middle = {0.0, 12.0 * kMm}, .height_m = 5.0 * kMm}, gauge.dial_node, gauge);
    append_hand({.name = "needle_100",
                 .stations = {{-12.0 * kMm, 2.4 * kMm},
                              {-6.0 * kMm, 1.5 * kMm},
                              {0.0, 1.25 * kMm},
                              {8.0 * kMm, 1.6 * kMm},
                              {30.0 * kMm, 1.1 * kMm},
                              {36.0 * kMm, 0.12 * kMm}},
                 .z_m = 4.6 * kMm,
                 .hub_radius_m = 3.8 * kMm},
                gauge);
    append_hub_cap(5.5 * kMm, gauge);
    append_knob(gauge);
    append_glass(gauge);
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0})
            append_terminal({38.0 * kMm * x, 38.0 * kMm * y}, gauge);
    }
    const auto so_far = static_cast<uint32_t>(gauge.mesh.triangle_count());
    CHECK(triangles >= so_far + 24 * 2 * 90);
    append_damper(triangles - so_far, gauge);
    return finish_gauge(std::move(gauge));
}

}  // namespace data
