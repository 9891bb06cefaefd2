// The parts of a gauge that are read: dial, ticks, lettering, hands, digit wheels.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "data/gauge_parts.h"
#include "data/solid.h"
#include "data/stroke_font.h"

namespace data {

namespace {

constexpr double kMm = 0.001;
constexpr double kRaisedM = 0.28 * kMm;  // marks above the dial: enough for a shadow line, not for parallax
constexpr double kMarkBevelM = 0.07 * kMm;

SolidTarget target_of(Gauge& gauge, uint32_t node, uint32_t material) {
    return {.mesh = &gauge.mesh, .node = node, .material = material};
}

/// Clockwise about z, seen from +z.
glm::dmat4 turned_clockwise(double angle_rad) {
    const double c = std::cos(angle_rad), s = std::sin(angle_rad);
    return glm::dmat4(glm::dvec4(c, -s, 0, 0), glm::dvec4(s, c, 0, 0), glm::dvec4(0, 0, 1, 0),
                      glm::dvec4(0, 0, 0, 1));
}

/// One wheel with its axis along x, ten flat faces; face `shown` looks at the pilot.
struct Wheel {
    glm::dvec3 axis_middle{0.0};
    double width_m = 0.0, face_distance_m = 0.0, digit_height_m = 0.0;
    int shown = 0;
};

/// The face frame of digit `digit`: x along the axis, y up the face, z out of it.
glm::dmat4 face_frame(const Wheel& wheel, int digit) {
    // the next higher digit sits below, so that it comes up when the wheel turns its front upwards
    const double angle = (digit - wheel.shown) * 2.0 * std::numbers::pi / 10.0;
    const double c = std::cos(angle), s = std::sin(angle);
    const glm::dvec3 out(0.0, -s, c), up(0.0, c, s);
    return {glm::dvec4(1, 0, 0, 0), glm::dvec4(up, 0.0), glm::dvec4(out, 0.0),
            glm::dvec4(wheel.axis_middle + wheel.face_distance_m * out, 1.0)};
}

void append_wheel(const Wheel& wheel, uint32_t node, Gauge& gauge) {
    const double half_face = wheel.face_distance_m * std::tan(std::numbers::pi / 10.0);
    const Shape face =
        ring_shape(rounded_rectangle(glm::dvec2(0.0), {wheel.width_m / 2.0, half_face}, 0.0, 0));
    for (int digit = 0; digit < 10; ++digit) {
        SolidTarget target = target_of(gauge, node, gauge.material.drum);
        target.node_from_solid = face_frame(wheel, digit);
        append_extrusion(face, {.z0 = -1.0 * kMm, .z1 = 0.0, .bevel = 0.15 * kMm}, target);
        target.material = gauge.material.mark;
        const char text[2] = {static_cast<char>('0' + digit), 0};
        append_extrusion(text_shape(text, glm::dvec2(0.0), wheel.digit_height_m, 0.17),
                         {.z0 = 0.0, .z1 = 0.12 * kMm, .bevel = 0.0}, target);
    }
}

}  // namespace

void append_dial(const Shape& openings, Gauge& gauge) {
    Shape disc = ring_shape(circle(glm::dvec2(0.0), kDialRadiusM + 0.3 * kMm, 128));
    if (!openings.empty()) disc = subtract(disc, openings);
    append_extrusion(disc, {.z0 = -1.2 * kMm, .z1 = 0.0, .bevel = 0.2 * kMm},
                     target_of(gauge, gauge.dial_node, gauge.material.dial));
}

void append_ticks(const TickScale& scale, uint32_t node, Gauge& gauge) {
    for (int tick = 0; tick < scale.count; ++tick) {
        const bool is_major = tick % scale.major_every == 0;
        const double width = is_major ? scale.major_width_m : scale.minor_width_m;
        const double length = is_major ? scale.major_m : scale.minor_m;
        const Polyline line{{0.0, scale.outer_m - length + width / 2.0}, {0.0, scale.outer_m - width / 2.0}};
        SolidTarget target = target_of(gauge, node, gauge.material.mark);
        target.node_from_solid = turned_clockwise(2.0 * std::numbers::pi * tick / scale.count);
        append_extrusion(stroke_shape({&line, 1}, width, 2), {.z0 = 0.0, .z1 = kRaisedM, .bevel = 0.0},
                         target);
    }
}

void append_text(std::string_view text, const Lettering& lettering, uint32_t node, Gauge& gauge) {
    SolidTarget target = target_of(gauge, node, gauge.material.mark);
    target.node_from_solid = turned_clockwise(lettering.turn_rad);
    append_extrusion(text_shape(text, lettering.middle, lettering.height_m, lettering.weight),
                     {.z0 = lettering.face_z_m, .z1 = lettering.face_z_m + kRaisedM, .bevel = 0.0}, target);
}

void append_line(const Polyline& line, double width_m, uint32_t node, Gauge& gauge) {
    append_extrusion(stroke_shape({&line, 1}, width_m, 4), {.z0 = 0.0, .z1 = kRaisedM, .bevel = kMarkBevelM},
                     target_of(gauge, node, gauge.material.mark));
}

void append_hand(const Hand& hand, Gauge& gauge) {
    const uint32_t node = add_node(gauge.mesh, hand.name, 0, glm::dmat4(1.0));
    const NeedleBody body{hand.z_m, hand.z_m + 0.45 * kMm, hand.z_m + 0.8 * kMm};
    std::vector<glm::dvec2> dark, bright;
    for (const glm::dvec2& station : hand.stations) {
        if (station.x <= hand.dark_below_y_m) dark.push_back(station);
        if (station.x >= hand.dark_below_y_m) bright.push_back(station);
    }
    append_needle(bright, body, target_of(gauge, node, gauge.material.needle));
    if (dark.size() > 1) append_needle(dark, body, target_of(gauge, node, gauge.material.dial));
    const double r = hand.hub_radius_m, top = hand.z_m + 0.95 * kMm;
    const std::array<glm::dvec2, 4> hub{glm::dvec2(0.0, top), glm::dvec2(r - 0.25 * kMm, top),
                                        glm::dvec2(r, top - 0.25 * kMm), glm::dvec2(r, hand.z_m)};
    append_lathe(hub, 64, target_of(gauge, node, gauge.material.dial));
}

void append_hub_cap(double z_m, Gauge& gauge) {
    std::vector<glm::dvec2> cap;
    for (int i = 0; i <= 8; ++i) {
        const double angle = std::numbers::pi / 2.0 * i / 8.0;
        cap.push_back({2.1 * kMm * std::sin(angle), z_m + 0.7 * kMm * std::cos(angle)});
    }
    cap.push_back({2.1 * kMm, 0.0});
    append_lathe(cap, 48, target_of(gauge, gauge.dial_node, gauge.material.steel));
}

void append_drum(const std::string& name, std::string_view digits, const glm::dvec2& middle, Gauge& gauge) {
    const uint32_t node = add_node(gauge.mesh, name, 0, glm::dmat4(1.0));
    const double pitch = 3.45 * kMm;
    Wheel wheel{.width_m = 3.3 * kMm, .face_distance_m = 7.2 * kMm, .digit_height_m = 3.1 * kMm};
    const double first = -0.5 * pitch * static_cast<double>(digits.size() - 1);
    for (size_t i = 0; i < digits.size(); ++i) {
        wheel.shown = std::clamp(digits[i] - '0', 0, 9);
        wheel.axis_middle = {middle.x + first + pitch * static_cast<double>(i), middle.y,
                             -0.9 * kMm - wheel.face_distance_m};
        append_wheel(wheel, node, gauge);
    }
}

PolygonMesh finish_gauge(Gauge gauge) {
    for (MeshNode& node : gauge.mesh.nodes)
        weld(node);
    return std::move(gauge.mesh);
}

}  // namespace data
