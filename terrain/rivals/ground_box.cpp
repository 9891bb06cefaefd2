#include "terrain/rivals/ground_box.h"

#include <cmath>
#include <limits>

#include "lod/screen_error.h"

namespace terrain {
namespace {

struct HeightRange {
    float min_m = std::numeric_limits<float>::infinity(), max_m = -min_m;
};

HeightRange height_range(const data::HeightGrid& grid, const GridPatch& patch) {
    HeightRange range;
    for (int row = patch.min_row; row <= patch.max_row; ++row) {
        const float* begin = &grid.height_m[grid.index(patch.min_col, row)];
        for (int i = 0; i <= patch.max_col - patch.min_col; ++i) {
            range.min_m = std::min(range.min_m, begin[i]);
            range.max_m = std::max(range.max_m, begin[i]);
        }
    }
    return range;
}

/// Whether the box lies wholly beyond one of the picture's five planes.
bool is_outside(const lod::ViewMetric& view, const glm::dvec3& centre, const glm::dmat3& axes,
                const glm::dvec3& half) {
    const auto is_beyond = [&](const glm::dvec3& outward) {
        const glm::dvec3 along(glm::dot(axes[0], outward), glm::dot(axes[1], outward),
                               glm::dot(axes[2], outward));
        return glm::dot(centre, outward) > glm::dot(glm::abs(along), half);
    };
    return is_beyond({1.0, 0.0, view.tan_x}) || is_beyond({-1.0, 0.0, view.tan_x}) ||
           is_beyond({0.0, 1.0, view.tan_y}) || is_beyond({0.0, -1.0, view.tan_y});
}

}  // namespace

GroundBox ground_box(const data::HeightGrid& grid, const GridPatch& patch) {
    const HeightRange range = height_range(grid, patch);
    const data::GroundFrame& frame = grid.frame;
    const int cols[2] = {patch.min_col, patch.max_col}, rows[2] = {patch.min_row, patch.max_row};
    const glm::dvec3 base =
        frame.world_from_sample((cols[0] + cols[1]) / 2, (rows[0] + rows[1]) / 2, double(range.min_m));
    GroundBox box;
    const glm::dvec3 up = frame.world().world_from_enu(base)[2];
    glm::dvec3 along = frame.world_from_sample(cols[1], rows[0], double(range.min_m)) -
                       frame.world_from_sample(cols[0], rows[0], double(range.min_m));
    along = glm::normalize(along - up * glm::dot(along, up));
    box.axes = glm::dmat3(along, glm::cross(up, along), up);

    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (int corner = 0; corner < 8; ++corner) {
        const double height_m = double((corner & 4) != 0 ? range.max_m : range.min_m);
        const glm::dvec3 at =
            (frame.world_from_sample(cols[corner & 1], rows[corner >> 1 & 1], height_m) - base) * box.axes;
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    // The ground bulges out of the corners' hull by no more than its chords in both directions.
    const double width = cols[1] - cols[0], height = rows[1] - rows[0];
    const auto chord = frame.chord_error_per_cell2();
    const double bulge = (width * width + height * height) * (chord.up_m + chord.side_m);
    const double rounding = 1e-15 * glm::length(base);
    box.half_m = (high - low) * 0.5 + (bulge + rounding);
    box.centre = base + box.axes * ((low + high) * 0.5);
    box.radius_m = glm::length(box.half_m);
    return box;
}

Sight sight_of(const lod::ViewMetric& view, const GroundBox& box) {
    const glm::dvec3 centre = view.eye_from_world * (box.centre - view.eye_world);
    if (lod::distance_outside_m(view, centre, box.radius_m) > 0.0) return {};
    const glm::dmat3 axes = view.eye_from_world * box.axes;
    const glm::dvec3& half = box.half_m;
    if (is_outside(view, centre, axes, half)) return {};
    const glm::dvec3 reach =
        glm::abs(axes[0]) * half.x + glm::abs(axes[1]) * half.y + glm::abs(axes[2]) * half.z;
    if (-centre.z + reach.z < view.near_m) return {};

    const glm::dvec3 beside = glm::max(glm::abs(centre * axes) - half, glm::dvec3(0.0));
    Sight sight;
    sight.depth_m = std::max({-centre.z - reach.z, glm::length(beside) / view.stretch, view.near_m});
    // A visible point is no deeper aslant than the picture's rim, nor than the box's own.
    const double x = std::min(view.tan_x, (std::abs(centre.x) + reach.x) / sight.depth_m);
    const double y = std::min(view.tan_y, (std::abs(centre.y) + reach.y) / sight.depth_m);
    sight.px_per_m = view.lambda_px * std::sqrt(1.0 + x * x + y * y) / sight.depth_m;
    return sight;
}

Sight sight_of(std::span<const lod::ViewMetric> views, const GroundBox& box) {
    Sight worst;
    for (const lod::ViewMetric& view : views) {
        const Sight one = sight_of(view, box);
        if (!one.is_visible()) continue;
        worst.depth_m = worst.is_visible() ? std::min(worst.depth_m, one.depth_m) : one.depth_m;
        worst.px_per_m = std::max(worst.px_per_m, one.px_per_m);
    }
    return worst;
}

}  // namespace terrain
