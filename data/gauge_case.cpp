// The parts of a gauge that carry and close it: plate, bezel, can, screws, knob, glass.
#include <array>
#include <cmath>
#include <numbers>

#include "data/gauge_parts.h"
#include "data/solid.h"

namespace data {

namespace {

constexpr double kMm = 0.001;
constexpr double kPlateFrontM = 2.2 * kMm;
constexpr int kRound = 72;  // segments of the large circles
const glm::dvec2 kKnobAt(-24.5 * kMm, -50.0 * kMm);

glm::dmat4 shifted(const glm::dvec3& by) {
    glm::dmat4 matrix(1.0);
    matrix[3] = glm::dvec4(by, 1.0);
    return matrix;
}

SolidTarget target_of(Gauge& gauge, uint32_t node, uint32_t material) {
    return {.mesh = &gauge.mesh, .node = node, .material = material};
}

void append_plate(bool has_knob_tab, Gauge& gauge) {
    const glm::dvec2 half(47.0 * kMm);
    Shape plate = ring_shape(rounded_rectangle(glm::dvec2(0.0), half, 10.0 * kMm, 12));
    if (has_knob_tab) plate = unite(plate, ring_shape(circle(kKnobAt, 11.5 * kMm, 64)));
    plate = subtract(plate, ring_shape(circle(glm::dvec2(0.0), 42.0 * kMm, kRound)));
    append_extrusion(plate, {.z0 = -3.0 * kMm, .z1 = kPlateFrontM, .bevel = 0.9 * kMm},
                     target_of(gauge, gauge.case_node, gauge.material.bezel));
}

/// A fillister head: a disc with two raised halves, the slot between them.
void append_screw(const glm::dvec2& at, double slot_rad, Gauge& gauge) {
    SolidTarget target = target_of(gauge, gauge.case_node, gauge.material.steel);
    target.node_from_solid = shifted({at, kPlateFrontM});
    const double c = std::cos(slot_rad), s = std::sin(slot_rad);
    Polyline slot = rounded_rectangle(glm::dvec2(0.0), glm::dvec2(9.0 * kMm, 0.55 * kMm), 0.0, 0);
    for (glm::dvec2& p : slot)
        p = glm::dvec2(c * p.x - s * p.y, s * p.x + c * p.y);
    const Shape head = ring_shape(circle(glm::dvec2(0.0), 3.9 * kMm, 56));
    append_extrusion(subtract(head, ring_shape(slot)), {.z0 = 0.0, .z1 = 1.7 * kMm, .bevel = 0.45 * kMm},
                     target);
    target.material = gauge.material.dial;
    append_extrusion(head, {.z0 = 0.0, .z1 = 0.6 * kMm, .bevel = 0.1 * kMm}, target);
    const std::array<glm::dvec2, 3> washer{glm::dvec2(3.9 * kMm, 0.35 * kMm),
                                           glm::dvec2(4.8 * kMm, 0.35 * kMm), glm::dvec2(5.1 * kMm, 0.0)};
    target.material = gauge.material.steel;
    append_lathe(washer, 56, target);
}

/// Seen from the pilot: glass seat, flat rim, chamfer, outer wall; then the well down to the dial; then the can.
void append_rings(Gauge& gauge) {
    const std::array<glm::dvec2, 9> bezel{
        glm::dvec2(41.2 * kMm, 4.9 * kMm), glm::dvec2(41.2 * kMm, 5.9 * kMm),
        glm::dvec2(41.7 * kMm, 6.4 * kMm), glm::dvec2(43.0 * kMm, 6.5 * kMm),
        glm::dvec2(43.6 * kMm, 6.3 * kMm), glm::dvec2(45.1 * kMm, 4.6 * kMm),
        glm::dvec2(45.4 * kMm, 4.1 * kMm), glm::dvec2(45.4 * kMm, 2.6 * kMm),
        glm::dvec2(45.8 * kMm, 2.1 * kMm)};
    append_lathe(bezel, kRound, target_of(gauge, gauge.case_node, gauge.material.bezel));
    const std::array<glm::dvec2, 4> well{glm::dvec2(40.0 * kMm, -0.2 * kMm),
                                         glm::dvec2(40.3 * kMm, 0.6 * kMm), glm::dvec2(40.7 * kMm, 4.2 * kMm),
                                         glm::dvec2(41.2 * kMm, 4.9 * kMm)};
    append_lathe(well, kRound, target_of(gauge, gauge.case_node, gauge.material.dial));
    const std::array<glm::dvec2, 4> can{glm::dvec2(42.0 * kMm, -3.0 * kMm),
                                        glm::dvec2(40.5 * kMm, -4.0 * kMm),
                                        glm::dvec2(40.0 * kMm, -58.0 * kMm), glm::dvec2(0.0, -60.0 * kMm)};
    append_lathe(can, kRound / 2, target_of(gauge, gauge.case_node, gauge.material.dial));
}

glm::vec4 colour(int red, int green, int blue, float opacity = 1.0f) {
    return {static_cast<float>(red) / 255.0f, static_cast<float>(green) / 255.0f,
            static_cast<float>(blue) / 255.0f, opacity};
}

}  // namespace

Gauge begin_gauge(const std::string& name) {
    Gauge gauge;
    PolygonMesh& mesh = gauge.mesh;
    gauge.material = {.bezel = add_material(mesh, "bezel, dark grey", colour(58, 60, 62)),
                      .dial = add_material(mesh, "dial, matt black", colour(22, 22, 23)),
                      .mark = add_material(mesh, "marks, white", colour(240, 240, 234)),
                      .needle = add_material(mesh, "hands, warm white", colour(250, 240, 218)),
                      .steel = add_material(mesh, "screws, steel", colour(150, 152, 156)),
                      .knob = add_material(mesh, "knob, black", colour(36, 36, 38)),
                      .drum = add_material(mesh, "digit wheels, black", colour(30, 30, 31)),
                      .accent = add_material(mesh, "index, orange", colour(236, 120, 36)),
                      .glass = add_material(mesh, "glass", colour(210, 225, 235, 0.12f))};
    // gauge (x, y, z) -> mesh (x, -z, y)
    const glm::dmat4 mesh_from_gauge(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, 1, 0), glm::dvec4(0, -1, 0, 0),
                                     glm::dvec4(0, 0, 0, 1));
    add_node(mesh, name, -1, mesh_from_gauge);
    gauge.case_node = add_node(mesh, "case", 0, glm::dmat4(1.0));
    gauge.dial_node = add_node(mesh, "dial", 0, glm::dmat4(1.0));
    return gauge;
}

void append_case(bool has_knob_tab, Gauge& gauge) {
    append_plate(has_knob_tab, gauge);
    append_rings(gauge);
    const double at = 39.2 * kMm;
    append_screw({at, at}, 0.35, gauge);
    append_screw({-at, at}, 1.9, gauge);
    append_screw({at, -at}, 2.7, gauge);
    append_screw({-at, -at}, 1.1, gauge);
}

void append_glass(Gauge& gauge) {
    const uint32_t node = add_node(gauge.mesh, "glass", 0, glm::dmat4(1.0));
    constexpr int kRings = 12;
    const double rim = 41.2 * kMm, edge_z = 5.3 * kMm, rise = 1.1 * kMm;
    std::vector<glm::dvec2> dome;
    for (int ring = 0; ring <= kRings; ++ring) {
        const double share = static_cast<double>(ring) / kRings;
        dome.push_back({rim * share, edge_z + rise * (1.0 - share * share)});
    }
    append_lathe(dome, kRound / 2, target_of(gauge, node, gauge.material.glass));
}

void append_knob(Gauge& gauge) {
    const uint32_t node = add_node(gauge.mesh, "knob", 0, shifted({kKnobAt, kPlateFrontM}));
    constexpr int kTeeth = 44;
    Polyline knurl;
    for (int i = 0; i < 4 * kTeeth; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / (4 * kTeeth);
        const double radius = (i % 4 < 2 ? 7.6 : 7.1) * kMm;
        knurl.push_back(radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    const Shape grip = ring_shape(knurl);
    append_extrusion(grip, {.z0 = 1.5 * kMm, .z1 = 9.5 * kMm, .bevel = 0.15 * kMm},
                     target_of(gauge, node, gauge.material.knob));
    const std::array<glm::dvec2, 6> crown{
        glm::dvec2(0.0, 9.9 * kMm),        glm::dvec2(4.2 * kMm, 9.9 * kMm),
        glm::dvec2(4.8 * kMm, 10.6 * kMm), glm::dvec2(6.2 * kMm, 10.6 * kMm),
        glm::dvec2(6.9 * kMm, 9.9 * kMm),  glm::dvec2(6.95 * kMm, 9.3 * kMm)};
    append_lathe(crown, 72, target_of(gauge, node, gauge.material.knob));
    const std::array<glm::dvec2, 3> collar{glm::dvec2(6.2 * kMm, 1.6 * kMm), glm::dvec2(8.4 * kMm, 1.1 * kMm),
                                           glm::dvec2(8.8 * kMm, 0.0)};
    append_lathe(collar, 72, target_of(gauge, node, gauge.material.steel));
    const Polyline line{{0.0, 5.0 * kMm}, {0.0, 6.0 * kMm}};
    append_extrusion(stroke_shape({&line, 1}, 0.9 * kMm, 4),
                     {.z0 = 10.5 * kMm, .z1 = 10.75 * kMm, .bevel = 0.0},
                     target_of(gauge, node, gauge.material.mark));
}

}  // namespace data
