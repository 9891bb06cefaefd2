#include "data/generated_gauges.h"

#include <array>
#include <cmath>
#include <numbers>

#include "data/gauge_parts.h"
#include "data/solid.h"

namespace data {

namespace {

constexpr double kMm = 0.001;

glm::dmat4 raised(double z_m) {
    glm::dmat4 matrix(1.0);
    matrix[3] = glm::dvec4(0.0, 0.0, z_m, 1.0);
    return matrix;
}

/// Upright numbers around a dial, one every `step`, from twelve o'clock.
void append_speeds(int count, int step, Gauge& gauge) {
    for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / count;
        const glm::dvec2 at = 27.2 * kMm * glm::dvec2(std::sin(angle), std::cos(angle));
        append_text(std::to_string(i * step), {.middle = at, .height_m = 4.9 * kMm}, gauge.dial_node, gauge);
    }
}

/// The turning card of the heading indicator: marks every five degrees, letters and tens of degrees every thirty.
void append_card(Gauge& gauge) {
    const uint32_t card = add_node(gauge.mesh, "card_-360", 0, raised(0.8 * kMm));
    append_extrusion(ring_shape(circle(glm::dvec2(0.0), 38.6 * kMm, 128)),
                     {.z0 = -0.6 * kMm, .z1 = 0.0, .bevel = 0.2 * kMm},
                     {.mesh = &gauge.mesh, .node = card, .material = gauge.material.dial});
    append_ticks({.count = 72, .major_every = 2, .outer_m = 37.6 * kMm}, card, gauge);
    constexpr std::array<const char*, 12> kNames{"N", "3",  "6",  "E", "12", "15",
                                                 "S", "21", "24", "W", "30", "33"};
    for (size_t i = 0; i < kNames.size(); ++i) {
        append_text(kNames[i],
                    {.middle = {0.0, 28.4 * kMm},
                     .height_m = (i % 3 == 0 ? 6.6 : 5.0) * kMm,
                     .turn_rad = 2.0 * std::numbers::pi * static_cast<double>(i) / 12.0},
                    card, gauge);
    }
}

/// An aeroplane seen from above, nose up, and the mark it points to; they stand above the card.
void append_aeroplane(Gauge& gauge) {
    const SolidTarget target{.mesh = &gauge.mesh,
                             .node = gauge.dial_node,
                             .material = gauge.material.accent,
                             .node_from_solid = raised(2.4 * kMm)};
    const std::array<Polyline, 4> lines{
        Polyline{{0.0, 17.0 * kMm}, {0.0, -13.0 * kMm}},
        Polyline{{-12.5 * kMm, 2.0 * kMm}, {0.0, 5.0 * kMm}, {12.5 * kMm, 2.0 * kMm}},
        Polyline{{-5.0 * kMm, -11.5 * kMm}, {5.0 * kMm, -11.5 * kMm}},
        Polyline{{0.0, 34.0 * kMm}, {0.0, 39.4 * kMm}}};
    append_extrusion(stroke_shape(lines, 1.5 * kMm, 6), {.z0 = 0.0, .z1 = 0.6 * kMm, .bevel = 0.2 * kMm},
                     target);
}

}  // namespace

PolygonMesh generate_airspeed_indicator() {
    Gauge gauge = begin_gauge("airspeed");
    append_case(false, gauge);
    append_dial({}, gauge);
    append_ticks({.count = 100, .major_every = 5}, gauge.dial_node, gauge);
    append_speeds(10, 20, gauge);
    append_text("SPEED", {.middle = {0.0, 14.6 * kMm}, .height_m = 3.4 * kMm}, gauge.dial_node, gauge);
    append_text("m/s", {.middle = {0.0, -14.0 * kMm}, .height_m = 3.0 * kMm}, gauge.dial_node, gauge);
    append_hand({.name = "needle_200",
                 .stations = {{-12.0 * kMm, 2.4 * kMm},
                              {-6.0 * kMm, 1.5 * kMm},
                              {0.0, 1.25 * kMm},
                              {8.0 * kMm, 1.6 * kMm},
                              {30.0 * kMm, 1.1 * kMm},
                              {36.0 * kMm, 0.12 * kMm}},
                 .z_m = 2.2 * kMm,
                 .hub_radius_m = 3.8 * kMm,
                 .dark_below_y_m = 0.0},
                gauge);
    append_hub_cap(3.1 * kMm, gauge);
    append_glass(gauge);
    return finish_gauge(std::move(gauge));
}

PolygonMesh generate_heading_indicator() {
    Gauge gauge = begin_gauge("heading");
    append_case(false, gauge);
    append_dial({}, gauge);
    append_card(gauge);
    append_aeroplane(gauge);
    append_glass(gauge);
    return finish_gauge(std::move(gauge));
}

PolygonMesh generate_panel() {
    Gauge gauge = begin_gauge("panel");
    const glm::dvec2 middle(0.0, -34.0 * kMm), half(kPanelPitchM + 62.0 * kMm, 100.0 * kMm);
    Shape plate = ring_shape(rounded_rectangle(middle, half, 30.0 * kMm, 24));
    Shape lip = plate;
    for (const double side : {-1.0, 0.0, 1.0}) {
        plate = subtract(plate, ring_shape(circle({side * kPanelPitchM, 0.0}, 43.0 * kMm, 96)));
    }
    const SolidTarget target{.mesh = &gauge.mesh, .node = gauge.case_node, .material = gauge.material.knob};
    append_extrusion(plate, {.z0 = -8.0 * kMm, .z1 = -2.5 * kMm, .bevel = 1.5 * kMm}, target);
    lip = subtract(lip, ring_shape(rounded_rectangle(middle, half - 4.0 * kMm, 26.0 * kMm, 24)));
    append_extrusion(lip, {.z0 = -8.0 * kMm, .z1 = 14.0 * kMm, .bevel = 1.2 * kMm}, target);
    return finish_gauge(std::move(gauge));
}

}  // namespace data
