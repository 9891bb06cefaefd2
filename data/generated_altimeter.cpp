#include "data/generated_altimeter.h"

#include <cmath>
#include <numbers>

#include "data/gauge_parts.h"

namespace data {

namespace {

constexpr double kMm = 0.001;
const glm::dvec2 kWindowAt(23.6 * kMm, 0.0);
const glm::dvec2 kWindowHalf(7.2 * kMm, 2.3 * kMm);

void append_numerals(Gauge& gauge) {
    constexpr double kRadius = 29.6 * kMm;
    for (int digit = 0; digit < 10; ++digit) {
        const double angle = 2.0 * std::numbers::pi * digit / 10.0;
        const char text[2] = {static_cast<char>('0' + digit), 0};
        const glm::dvec2 at = kRadius * glm::dvec2(std::sin(angle), std::cos(angle));
        append_text(text, {.middle = at, .height_m = 7.4 * kMm, .weight = 0.17}, gauge.dial_node, gauge);
    }
}

void append_labels(Gauge& gauge) {
    append_text("ALT", {.middle = {0.0, 15.2 * kMm}, .height_m = 3.6 * kMm}, gauge.dial_node, gauge);
    append_text("x100 m", {.middle = {0.0, -14.6 * kMm}, .height_m = 2.9 * kMm}, gauge.dial_node, gauge);
    append_text("hPa", {.middle = {12.6 * kMm, -4.6 * kMm}, .height_m = 1.9 * kMm}, gauge.dial_node, gauge);
}

/// A thin white frame around the pressure window.
void append_window_frame(Gauge& gauge) {
    Polyline frame = rounded_rectangle(kWindowAt, kWindowHalf + 0.35 * kMm, 0.6 * kMm, 4);
    frame.push_back(frame.front());
    append_line(frame, 0.32 * kMm, gauge.dial_node, gauge);
}

void append_hands(Gauge& gauge) {
    append_hand({.name = "needle_100000",
                 .stations = {{-9.0 * kMm, 0.7 * kMm},
                              {0.0, 0.7 * kMm},
                              {29.5 * kMm, 0.45 * kMm},
                              {30.2 * kMm, 2.3 * kMm},
                              {34.8 * kMm, 0.0}},
                 .z_m = 0.8 * kMm,
                 .hub_radius_m = 4.2 * kMm,
                 .dark_below_y_m = 0.0},
                gauge);
    append_hand({.name = "needle_10000",
                 .stations = {{-9.0 * kMm, 1.9 * kMm},
                              {0.0, 1.4 * kMm},
                              {9.0 * kMm, 2.2 * kMm},
                              {15.5 * kMm, 3.3 * kMm},
                              {22.5 * kMm, 0.0}},
                 .z_m = 1.95 * kMm,
                 .hub_radius_m = 3.9 * kMm,
                 .dark_below_y_m = 0.0},
                gauge);
    append_hand({.name = "needle_1000",
                 .stations = {{-12.5 * kMm, 2.4 * kMm},
                              {-7.0 * kMm, 1.5 * kMm},
                              {0.0, 1.25 * kMm},
                              {8.0 * kMm, 1.7 * kMm},
                              {30.0 * kMm, 1.25 * kMm},
                              {36.4 * kMm, 0.12 * kMm}},
                 .z_m = 3.1 * kMm,
                 .hub_radius_m = 3.5 * kMm,
                 .dark_below_y_m = 0.0},
                gauge);
    append_hub_cap(4.05 * kMm, gauge);
}

}  // namespace

PolygonMesh generate_altimeter() {
    Gauge gauge = begin_gauge("altimeter");
    append_case(true, gauge);
    append_dial(ring_shape(rounded_rectangle(kWindowAt, kWindowHalf, 0.4 * kMm, 3)), gauge);
    append_window_frame(gauge);
    append_ticks({}, gauge.dial_node, gauge);
    append_numerals(gauge);
    append_labels(gauge);
    append_drum("pressure_drum", "1013", kWindowAt, gauge);
    append_hands(gauge);
    append_knob(gauge);
    append_glass(gauge);
    return finish_gauge(std::move(gauge));
}

}  // namespace data
