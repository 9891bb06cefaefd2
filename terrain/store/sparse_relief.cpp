#include "terrain/store/sparse_relief.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "terrain/page_layout.h"
#include "terrain/triangle_rows.h"

namespace terrain {
namespace {

/// The plane over three samples, in double precision.
struct Plane {
    GridPoint origin;
    double at_origin_m = 0.0, gradient_x = 0.0, gradient_y = 0.0;

    double at(int x, int y) const {
        return at_origin_m + gradient_x * (x - origin.x) + gradient_y * (y - origin.y);
    }
};

Plane plane_over(const SparseRelief& relief, GridPoint a, GridPoint b, GridPoint c) {
    const double a_m = double(relief.height_at(a));
    const double b_m = double(relief.height_at(b)) - a_m, c_m = double(relief.height_at(c)) - a_m;
    const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
    const double area = bx * cy - cx * by;
    return {a, a_m, (b_m * cy - c_m * by) / area, (c_m * bx - b_m * cx) / area};
}

/// Largest |sample - plane| over what a triangle covers of a patch.
double patch_residual(const ReliefPatch& patch, const RowSpans& rows, const Plane& plane) {
    double worst = 0.0;
    const int last_row = std::min(rows.last_row(), patch.first.y + patch.height - 1);
    for (int y = std::max(rows.first_row(), patch.first.y); y <= last_row; ++y) {
        int begin = 0, last = 0;
        if (!rows.span(y, begin, last)) continue;
        begin = std::max(begin, patch.first.x);
        last = std::min(last, patch.first.x + patch.width - 1);
        for (int x = begin; x <= last; ++x)
            worst = std::max(worst, std::abs(double(patch.at({x, y})) - plane.at(x, y)));
    }
    return worst;
}

/// The next float above, unless it is exactly 0: what is level stays so.
float rounded_up(double value) {
    return value == 0.0 ? 0.0f
                        : std::nextafter(static_cast<float>(value * (1.0 + 1e-9)),
                                         std::numeric_limits<float>::infinity());
}

/// Longest edge of a level's triangles, in cells.
double longest_edge_cells(const Domain& domain, int level) {
    return domain.reach(level) * ((level & 1) == 0 ? 2.0 * std::sqrt(2.0) : 2.0);
}

/// What chords lose on the curved Earth, over a plane with these gradients.
float chord_error_m(const SparseRelief& relief, int level, float gradient_x, float gradient_y) {
    const auto chord = relief.frame.chord_error_per_cell2();
    if (!(chord.up_m > 0.0)) return 0.0f;
    const glm::dvec2 cell = relief.frame.cell_m();
    const double cells = longest_edge_cells(relief.domain, level);
    const double slope = std::abs(double(gradient_x)) / cell.x + std::abs(double(gradient_y)) / cell.y;
    return static_cast<float>(cells * cells * (chord.up_m + slope * chord.side_m));
}

}  // namespace

float SparseRelief::height_at(GridPoint p) const {
    const GridPoint at = domain.clamped(p);
    for (const ReliefPatch& patch : patches) {
        if (patch.contains(at)) return patch.at(at);
    }
    return level_m;
}

TriangleError sparse_triangle_error(const SparseRelief& relief, const TriangleCorners& t) {
    const GridPoint a = relief.domain.clamped(t.apex), b = relief.domain.clamped(t.left),
                    c = relief.domain.clamped(t.right);
    if (is_degenerate(a, b, c)) return {};
    const Plane plane = plane_over(relief, a, b, c);
    const RowSpans rows(a, b, c);
    const auto is_inside = [&](const ReliefPatch& patch) {
        return patch.contains(a) && patch.contains(b) && patch.contains(c);
    };
    double worst = 0.0;
    // A plane is farthest from level ground at a corner.
    if (std::none_of(relief.patches.begin(), relief.patches.end(), is_inside)) {
        for (const GridPoint corner : {a, b, c})
            worst = std::max(worst, std::abs(double(relief.height_at(corner)) - double(relief.level_m)));
    }
    const int left = std::min({a.x, b.x, c.x}), right = std::max({a.x, b.x, c.x});
    for (const ReliefPatch& patch : relief.patches) {
        if (patch.first.x > right || patch.first.x + patch.width <= left) continue;
        worst = std::max(worst, patch_residual(patch, rows, plane));
    }
    return {rounded_up(worst), static_cast<float>(plane.gradient_x), static_cast<float>(plane.gradient_y)};
}

DiamondSource sparse_facts(const SparseRelief& relief, GridPoint centre, int level) {
    const Domain& domain = relief.domain;
    const int apex_dir = apex_direction(domain, centre, level), reach = domain.reach(level);
    DiamondSource source;
    source.height_m = relief.height_at(centre);
    float rise_m = 0.0f, error_m = 0.0f;
    for (int corner = 0; corner < 4; ++corner) {
        const GridPoint p = step_from(centre, apex_dir + 2 * corner, reach);
        if (domain.contains(p)) rise_m = std::max(rise_m, std::abs(relief.height_at(p) - source.height_m));
    }
    source.set_rise(rise_m);
    for (int half = 0; half < 2; ++half) {
        const int dir = (apex_dir + 4 * half) & 7;
        const TriangleCorners t{step_from(centre, dir, reach), step_from(centre, dir + 2, reach),
                                step_from(centre, dir - 2, reach)};
        if (!domain.contains(t.apex)) continue;
        const TriangleError raw = sparse_triangle_error(relief, t);
        error_m =
            std::max(error_m, raw.residual_m + chord_error_m(relief, level, raw.gradient_x, raw.gradient_y));
    }
    source.error_code = encode_length(error_m);
    return source;
}

void fill_level_page(const SparseRelief& relief, int group, std::span<DiamondSource> out) {
    for (size_t entry = 0; entry < out.size(); ++entry) {
        const int level = 2 * group + (entry < kSquareEntries ? 0 : 1);
        out[entry] = {};
        out[entry].height_m = relief.level_m;
        out[entry].error_code = encode_length(chord_error_m(relief, level, 0.0f, 0.0f));
    }
}

}  // namespace terrain
