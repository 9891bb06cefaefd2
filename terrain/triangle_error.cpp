#include "terrain/triangle_error.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "terrain/triangle_rows.h"

namespace terrain {
namespace {

using Lanes = float __attribute__((vector_size(32)));
constexpr int kLaneCount = 8;

/// Four roundings of the plane's value, in units of the largest height involved.
constexpr float kRoundingShare = 4.0f * 0x1p-24f;

/// A bound on rounding: heights of `scale` metres through four float operations. Exact residuals stay exact.
float with_rounding(float residual, float scale) {
    return residual == 0.0f ? 0.0f : residual + scale * kRoundingShare;
}

/// max_residual; rows too short for a vector stay here, without a call.
inline float row_residual(const float* samples, int count, float first, float gradient) {
    if (count >= kLaneCount) return max_residual(samples, count, first, gradient);
    float worst = 0.0f;
    for (int i = 0; i < count; ++i) {
        worst = std::max(worst, std::abs(samples[i] - (first + gradient * static_cast<float>(i))));
    }
    return worst;
}

/// How far the sample between two corners, two cells apart along each axis they differ in, is from their mean.
float sagitta(const data::HeightGrid& grid, GridPoint p, float p_m, GridPoint q, float q_m) {
    return std::abs(grid.at((p.x + q.x) / 2, (p.y + q.y) / 2) - 0.5f * (p_m + q_m));
}

/// A square-type triangle: legs along the axes from the apex.
float legs_on_axes(const data::HeightGrid& grid, const TriangleCorners& t, float gx, float gy) {
    const int n = std::abs(t.left.x + t.right.x - 2 * t.apex.x);  // one of the two legs is along x
    const int sx = t.left.x + t.right.x > 2 * t.apex.x ? 1 : -1;
    const int sy = t.left.y + t.right.y > 2 * t.apex.y ? 1 : -1;
    const float apex_m = grid.at(t.apex.x, t.apex.y);
    float worst = 0.0f;
    for (int row = 0; row <= n; ++row) {
        const int y = t.apex.y + sy * row;
        const int x = sx > 0 ? t.apex.x : t.apex.x - (n - row);
        const float first =
            apex_m + gy * static_cast<float>(sy * row) + gx * static_cast<float>(x - t.apex.x);
        worst = std::max(worst, row_residual(&grid.height_m[grid.index(x, y)], n - row + 1, first, gx));
    }
    return worst;
}

/// A turned triangle: hypotenuse along x (rows shrink towards the apex) or along y (rows grow to the middle).
float hypotenuse_on_axis(const data::HeightGrid& grid, const TriangleCorners& t, float gx, float gy) {
    const GridPoint mid{(t.left.x + t.right.x) / 2, (t.left.y + t.right.y) / 2};
    const bool along_x = t.left.y == t.right.y;
    const int n = along_x ? std::abs(t.apex.y - mid.y) : std::abs(t.apex.x - mid.x);
    const int side = along_x ? (t.apex.y > mid.y ? 1 : -1) : (t.apex.x > mid.x ? 1 : -1);
    const float apex_m = grid.at(t.apex.x, t.apex.y);
    float worst = 0.0f;
    for (int row = along_x ? 0 : -n; row <= n; ++row) {
        const int reach = n - std::abs(row);
        const int y = along_x ? mid.y + side * row : mid.y + row;
        const int x = along_x ? mid.x - reach : (side > 0 ? mid.x : mid.x - reach);
        const int count = along_x ? 2 * reach + 1 : reach + 1;
        const float first =
            apex_m + gy * static_cast<float>(y - t.apex.y) + gx * static_cast<float>(x - t.apex.x);
        worst = std::max(worst, row_residual(&grid.height_m[grid.index(x, y)], count, first, gx));
    }
    return worst;
}

}  // namespace

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
__attribute__((target_clones("avx2", "default")))
#endif
float max_residual(const float* samples, int count, float first, float gradient) {
    float worst = 0.0f;
    int i = 0;
    if (count >= kLaneCount) {
        const Lanes step = {0, 1, 2, 3, 4, 5, 6, 7};
        Lanes worst_lanes = {};
        for (; i + kLaneCount <= count; i += kLaneCount) {
            Lanes sample;
            std::memcpy(&sample, samples + i, sizeof(sample));
            const Lanes plane = first + gradient * (static_cast<float>(i) + step);
            const Lanes difference = sample - plane;
            const Lanes size = difference < 0.0f ? -difference : difference;
            worst_lanes = size > worst_lanes ? size : worst_lanes;
        }
        for (int lane = 0; lane < kLaneCount; ++lane)
            worst = std::max(worst, worst_lanes[lane]);
    }
    for (; i < count; ++i) {
        worst = std::max(worst, std::abs(samples[i] - (first + gradient * static_cast<float>(i))));
    }
    return worst;
}

TriangleError regular_triangle_error(const data::HeightGrid& grid, const TriangleCorners& t) {
    const float a = grid.at(t.apex.x, t.apex.y);
    const float l = grid.at(t.left.x, t.left.y), r = grid.at(t.right.x, t.right.y);
    const float scale = std::max({std::abs(a), std::abs(l), std::abs(r)});
    // Gradients along x and y in metres per cell; divisions by powers of two are exact.
    float gx, gy, worst;
    if (t.left.x != t.right.x && t.left.y != t.right.y) {
        const bool left_on_x = t.left.y == t.apex.y;
        const GridPoint on_x = left_on_x ? t.left : t.right, on_y = left_on_x ? t.right : t.left;
        gx = ((left_on_x ? l : r) - a) / static_cast<float>(on_x.x - t.apex.x);
        gy = ((left_on_x ? r : l) - a) / static_cast<float>(on_y.y - t.apex.y);
        // Three quarters of all diamonds are of the two finest levels: their few samples lie on the sides.
        worst = std::abs(on_x.x - t.apex.x) == 2
                    ? std::max({sagitta(grid, t.left, l, t.right, r), sagitta(grid, t.apex, a, t.left, l),
                                sagitta(grid, t.apex, a, t.right, r)})
                    : legs_on_axes(grid, t, gx, gy);
    } else if (t.left.y == t.right.y) {
        gx = (r - l) / static_cast<float>(t.right.x - t.left.x);
        gy = (a - 0.5f * (l + r)) / static_cast<float>(t.apex.y - t.left.y);
        worst = std::abs(t.apex.y - t.left.y) == 1 ? sagitta(grid, t.left, l, t.right, r)
                                                   : hypotenuse_on_axis(grid, t, gx, gy);
    } else {
        gy = (r - l) / static_cast<float>(t.right.y - t.left.y);
        gx = (a - 0.5f * (l + r)) / static_cast<float>(t.apex.x - t.left.x);
        worst = std::abs(t.apex.x - t.left.x) == 1 ? sagitta(grid, t.left, l, t.right, r)
                                                   : hypotenuse_on_axis(grid, t, gx, gy);
    }
    return {with_rounding(worst, scale), gx, gy};
}

TriangleError clamped_triangle_error(const data::HeightGrid& grid, const Domain& domain,
                                     const TriangleCorners& t) {
    const GridPoint a = domain.clamped(t.apex), l = domain.clamped(t.left), r = domain.clamped(t.right);
    if (is_degenerate(a, l, r)) return {};
    const double ha = double(grid.at(a.x, a.y));
    const double hl = double(grid.at(l.x, l.y)) - ha, hr = double(grid.at(r.x, r.y)) - ha;
    const double lx = l.x - a.x, ly = l.y - a.y, rx = r.x - a.x, ry = r.y - a.y;
    const double area = lx * ry - rx * ly;
    const double gx = (hl * ry - hr * ly) / area, gy = (hr * lx - hl * rx) / area;
    const RowSpans rows(a, l, r);
    float worst = 0.0f;
    for (int y = rows.first_row(); y <= rows.last_row(); ++y) {
        int x = 0, x_last = 0;
        if (!rows.span(y, x, x_last)) continue;
        const double first = ha + gx * (x - a.x) + gy * (y - a.y);
        worst = std::max(worst, row_residual(&grid.height_m[grid.index(x, y)], x_last - x + 1,
                                             static_cast<float>(first), static_cast<float>(gx)));
    }
    // The gradient itself is rounded here: up to 2^-24 of it for every cell of the widest row.
    const float slack = static_cast<float>(std::abs(gx) * domain.width * 0x1p-23);
    const float scale = std::max({std::abs(float(ha)), std::abs(float(ha + hl)), std::abs(float(ha + hr))});
    return {worst == 0.0f ? 0.0f : with_rounding(worst, scale) + slack, static_cast<float>(gx),
            static_cast<float>(gy)};
}

VoidCover void_cover(const data::HeightGrid& grid, const Domain& domain, const TriangleCorners& t) {
    VoidCover cover;
    const GridPoint a = domain.clamped(t.apex), l = domain.clamped(t.left), r = domain.clamped(t.right);
    if (is_degenerate(a, l, r)) return cover;
    const RowSpans rows(a, l, r);
    for (int y = rows.first_row(); y <= rows.last_row() && !(cover.any_valid && cover.any_void); ++y) {
        int x = 0, x_last = 0;
        if (!rows.span(y, x, x_last)) continue;
        for (; x <= x_last; ++x)
            (grid.void_at(x, y) ? cover.any_void : cover.any_valid) = true;
    }
    return cover;
}

}  // namespace terrain
