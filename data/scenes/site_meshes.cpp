#include "data/scenes/site_meshes.h"

#include "data/scenes/site_plan.h"

namespace data::site {

namespace {

constexpr double kHalfBayM = kBayM / 2.0;
constexpr double kSlabM = 0.3;  // thickness

void append_lattice(double half, double height, int braces, const Colour& colour, TimedMesh& mesh) {
    const glm::dvec2 corners[] = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
    for (size_t side = 0; side < 4; ++side) {
        const glm::dvec2 &here = corners[side], &next = corners[(side + 1) % 4];
        append_bar({{here, 0.0}, {here, height}, 0.16, 0.16}, colour, mesh);
        for (int i = 0; i < braces; ++i) {
            const double low = height * i / braces, high = height * (i + 1) / braces;
            const bool is_rising = i % 2 == 0;
            append_bar({{here, is_rising ? low : high}, {next, is_rising ? high : low}, 0.08, 0.08}, colour,
                       mesh);
        }
    }
}

}  // namespace

TimedMesh make_slab() {
    TimedMesh mesh;
    const double edge = kHalfBayM - 0.01;
    append_box({-edge, -edge, -kSlabM}, {edge, edge, 0.0}, kPaleConcrete, mesh);
    for (const double y : {-1.75, 0.0, 1.75})
        append_box({-edge, y - 0.12, -0.6}, {edge, y + 0.12, -kSlabM}, kConcrete, mesh);
    return mesh;
}

TimedMesh make_column(const glm::dvec2& lean) {
    TimedMesh mesh;
    const double top = kStoreyM - kSlabM;
    append_tube({{0, 0, 0}, {lean, top}, 0.42, 8}, kConcrete, mesh);
    append_box({-0.6, -0.6, 0.0}, {0.6, 0.6, 0.12}, kSteel, mesh);
    append_box({lean.x - 0.6, lean.y - 0.6, top - 0.5}, {lean.x + 0.6, lean.y + 0.6, top}, kPaleConcrete,
               mesh);
    return mesh;
}

TimedMesh make_core_wall() {
    TimedMesh mesh;
    const double top = kStoreyM - kSlabM;
    append_box({-kHalfBayM, -0.2, 0.0}, {-0.8, 0.2, top}, kConcrete, mesh);
    append_box({0.8, -0.2, 0.0}, {kHalfBayM, 0.2, top}, kConcrete, mesh);
    append_box({-0.8, -0.2, 2.3}, {0.8, 0.2, top}, kConcrete, mesh);
    return mesh;
}

TimedMesh make_beam() {
    TimedMesh mesh;
    const double half = kHalfBayM - 0.45;
    append_box({-half, -0.02, -0.86}, {half, 0.02, -0.34}, kPrimer, mesh);
    append_box({-half, -0.15, -0.34}, {half, 0.15, -0.3}, kPrimer, mesh);
    append_box({-half, -0.15, -0.9}, {half, 0.15, -0.86}, kPrimer, mesh);
    for (const double x : {-half - 0.03, half})
        append_box({x, -0.18, -0.9}, {x + 0.03, 0.18, -0.3}, kSteel, mesh);
    return mesh;
}

TimedMesh make_stairs() {
    TimedMesh mesh;
    const int steps = 18;
    for (int i = 0; i < steps; ++i) {
        const double y = -2.5 + 5.0 * i / steps, z = kStoreyM * (i + 1) / steps;
        append_box({-0.7, y, z - 0.06}, {0.7, y + 0.3, z}, kPaleConcrete, mesh);
    }
    for (const double x : {-0.75, 0.75})
        append_bar({{x, -2.5, 0.0}, {x, 2.5, kStoreyM - 0.1}, 0.08, 0.3}, kSteel, mesh);
    return mesh;
}

TimedMesh make_lift_door() {
    TimedMesh mesh;
    append_box({-0.6, -0.08, 0.0}, {-0.02, 0.0, 2.2}, kAluminium, mesh);
    append_box({0.02, -0.08, 0.0}, {0.6, 0.0, 2.2}, kAluminium, mesh);
    append_box({-0.7, -0.12, 2.2}, {0.7, 0.0, 2.35}, kSteel, mesh);
    return mesh;
}

TimedMesh make_partition() {
    TimedMesh mesh;
    append_box({-1.7, -0.06, 0.1}, {1.7, 0.06, 3.1}, kWhite, mesh);
    append_box({-1.7, -0.08, 0.0}, {1.7, 0.08, 0.1}, kSteel, mesh);
    append_box({-1.7, -0.08, 3.1}, {1.7, 0.08, 3.2}, kAluminium, mesh);
    return mesh;
}

TimedMesh make_duct() {
    TimedMesh mesh;
    append_tube({{-3.2, 0, 2.75}, {3.2, 0, 2.75}, 0.28, 12}, kAluminium, mesh);
    append_tube({{-3.2, 0.55, 2.85}, {3.2, 0.55, 2.85}, 0.08, 6}, kPrimer, mesh);
    return mesh;
}

TimedMesh make_desk() {
    TimedMesh mesh;
    append_box({-0.8, -0.4, 0.7}, {0.8, 0.4, 0.74}, kPlywood, mesh);
    append_box({-0.75, -0.35, 0.0}, {-0.7, 0.35, 0.7}, kSteel, mesh);
    append_box({0.3, -0.35, 0.05}, {0.75, 0.35, 0.7}, kWhite, mesh);
    append_box({-0.35, 0.1, 0.85}, {0.35, 0.14, 1.25}, kRubber, mesh);
    append_box({-0.25, -0.95, 0.42}, {0.25, -0.5, 0.48}, kSteel, mesh);
    append_box({-0.25, -1.0, 0.5}, {0.25, -0.95, 1.0}, kSteel, mesh);
    return mesh;
}

TimedMesh make_railing() {
    TimedMesh mesh;
    for (const double x : {-3.4, 0.0, 3.4})
        append_box({x - 0.04, -0.04, 0.0}, {x + 0.04, 0.04, 1.2}, kSafety, mesh);
    for (const double z : {0.1, 0.6, 1.1})
        append_box({-kHalfBayM, -0.03, z - 0.05}, {kHalfBayM, 0.03, z + 0.05}, kSafety, mesh);
    return mesh;
}

TimedMesh make_formwork() {
    TimedMesh mesh;
    append_box({-3.3, -3.3, -0.95}, {3.3, 3.3, -0.91}, kPlywood, mesh);
    for (const double x : {-2.6, -0.9, 0.9, 2.6})
        append_box({x - 0.06, -3.2, -1.15}, {x + 0.06, 3.2, -0.95}, kYellow, mesh);
    for (const double x : {-2.6, 2.6}) {
        for (const double y : {-2.4, 2.4})
            append_bar({{x, y, -kStoreyM}, {x, y, -1.15}, 0.12, 0.12}, kYellow, mesh);
    }
    return mesh;
}

TimedMesh make_prop() {
    TimedMesh mesh;
    append_tube({{0, 0, -kStoreyM + 0.05}, {0, 0, -0.65}, 0.06, 8}, kYellow, mesh);
    append_box({-0.15, -0.15, -kStoreyM}, {0.15, 0.15, -kStoreyM + 0.05}, kSteel, mesh);
    append_box({-0.2, -0.2, -0.65}, {0.2, 0.2, -0.6}, kSteel, mesh);
    return mesh;
}

TimedMesh make_rebar() {
    TimedMesh mesh;
    for (int i = 0; i < 5; ++i) {
        const double at = -2.8 + 1.4 * i;
        append_bar({{at, -3.3, 0.02}, {at, 3.3, 0.02}, 0.05, 0.05}, kRust, mesh);
        append_bar({{-3.3, at, 0.07}, {3.3, at, 0.07}, 0.05, 0.05}, kRust, mesh);
    }
    return mesh;
}

TimedMesh make_facade(const Colour& glass) {
    TimedMesh mesh;
    append_box({-0.72, -0.05, 0.9}, {0.72, -0.02, 3.6}, glass, mesh);
    append_box({-0.72, -0.06, -0.3}, {0.72, 0.0, 0.9}, kSteel, mesh);
    for (const double x : {-0.75, 0.69})
        append_box({x, -0.12, -0.3}, {x + 0.06, 0.02, 3.7}, kAluminium, mesh);
    for (const double z : {0.87, 3.6})
        append_box({-0.72, -0.1, z}, {0.72, 0.0, z + 0.06}, kAluminium, mesh);
    append_box({0.71, -0.45, -0.3}, {0.75, -0.12, 3.7}, kWhite, mesh);
    return mesh;
}

TimedMesh make_scaffold() {
    TimedMesh mesh;
    for (const double x : {-3.45, 3.45}) {
        for (const double y : {-0.5, 0.5})
            append_bar({{x, y, 0.0}, {x, y, 4.2}, 0.06, 0.06}, kSteel, mesh);
    }
    for (const double z : {0.0, 2.0})
        append_box({-3.45, -0.45, z + 0.1}, {3.45, 0.45, z + 0.16}, kPlywood, mesh);
    for (const double z : {1.0, 3.2, 4.1})
        append_bar({{-3.45, -0.5, z}, {3.45, -0.5, z}, 0.05, 0.05}, kSafety, mesh);
    for (const double z : {0.0, 2.1})
        append_bar({{-3.45, -0.5, z}, {3.45, -0.5, z + 2.0}, 0.05, 0.05}, kSteel, mesh);
    append_bar({{3.45, -0.5, 2.0}, {3.45, 0.5, 2.0}, 0.05, 0.05}, kSteel, mesh);
    return mesh;
}

TimedMesh make_mast() {
    TimedMesh mesh;
    append_lattice(0.9, 6.0, 3, kYellow, mesh);
    return mesh;
}

TimedMesh make_hoist_mast() {
    TimedMesh mesh;
    append_lattice(0.35, kStoreyM, 1, kSteel, mesh);
    return mesh;
}

TimedMesh make_tree() {
    TimedMesh mesh;
    append_tube({{0, 0, 0}, {0.1, 0, 4.0}, 0.18, 6}, kRust, mesh);
    append_lump({0.1, 0.1, 5.6}, {2.3, 2.2, 2.4}, kLeaf, mesh);
    append_lump({0.9, -0.8, 4.6}, {1.6, 1.7, 1.5}, Colour{74, 106, 52}, mesh);
    append_lump({0.2, 1.1, 3.9}, {1.3, 1.2, 1.1}, Colour{82, 114, 58}, mesh);
    append_lump({-0.8, 0.5, 7.4}, {1.5, 1.4, 1.6}, Colour{104, 140, 72}, mesh);
    return mesh;
}

}  // namespace data::site
