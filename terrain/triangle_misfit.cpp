#include "terrain/triangle_misfit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace terrain {
namespace {

/// One side of a triangle, as far as rows of samples are concerned. x = from.x + dx / dy * (y - from.y).
struct Side {
    GridPoint from, to;
    int step = 0;           ///< dx / dy where that is whole: it is, unless corners were clamped
    bool is_whole = false;  ///< or the side is level

    Side(GridPoint a, GridPoint b) : from(a.y < b.y ? a : b), to(a.y < b.y ? b : a) {
        const int dx = to.x - from.x, dy = to.y - from.y;
        is_whole = dy == 0 || dx % dy == 0;
        step = dy == 0 || !is_whole ? 0 : dx / dy;
    }

    /// Widens [first, last] to the samples of row y between the side and what is there already.
    void widen(int y, int& first, int& last) const {
        if (y < from.y || y > to.y) return;
        if (from.y == to.y) {
            first = std::min({first, from.x, to.x});
            last = std::max({last, from.x, to.x});
        } else if (is_whole) {
            const int x = from.x + step * (y - from.y);
            first = std::min(first, x);
            last = std::max(last, x);
        } else {
            const int64_t dy = to.y - from.y, across = int64_t{to.x - from.x} * (y - from.y);
            const int64_t down = across >= 0 ? across / dy : -((-across + dy - 1) / dy);
            const int64_t up = down * dy == across ? down : down + 1;
            first = std::min(first, from.x + static_cast<int>(up));
            last = std::max(last, from.x + static_cast<int>(down));
        }
    }
};

/// Height at the apex and metres per column and row.
struct Plane {
    double apex_m = 0.0, per_col = 0.0, per_row = 0.0;
};

double largest_distance(const float* samples, int count, double first_m, double per_col) {
    double worst_m = 0.0;
    for (int i = 0; i < count; ++i)
        worst_m = std::max(worst_m, std::abs(double(samples[i]) - (first_m + per_col * i)));
    return worst_m;
}

}  // namespace

double triangle_misfit(const data::HeightGrid& grid, const Domain& domain, const TriangleCorners& corners,
                       double enough_m) {
    const GridPoint a = domain.clamped(corners.apex), l = domain.clamped(corners.left),
                    r = domain.clamped(corners.right);
    const double lx = l.x - a.x, ly = l.y - a.y, rx = r.x - a.x, ry = r.y - a.y;
    const double area = lx * ry - rx * ly;
    if (area == 0.0) return 0.0;
    const double apex_m = double(grid.at(a.x, a.y));
    const double left_m = double(grid.at(l.x, l.y)) - apex_m, right_m = double(grid.at(r.x, r.y)) - apex_m;
    const Plane plane{apex_m, (left_m * ry - right_m * ly) / area, (right_m * lx - left_m * rx) / area};

    const std::array<Side, 3> sides = {Side(a, l), Side(l, r), Side(r, a)};
    const auto [low_y, high_y] = std::minmax({a.y, l.y, r.y});
    const bool is_void = grid.void_at(a.x, a.y);
    double worst_m = 0.0;
    for (int y = low_y; y <= high_y; ++y) {
        int first = std::numeric_limits<int>::max(), last = std::numeric_limits<int>::min();
        for (const Side& side : sides)
            side.widen(y, first, last);
        if (first > last) continue;
        if (grid.has_voids()) {
            for (int x = first; x <= last; ++x) {
                if (grid.void_at(x, y) != is_void) return std::numeric_limits<double>::infinity();
            }
            if (is_void) continue;
        }
        const double first_m = plane.apex_m + plane.per_col * (first - a.x) + plane.per_row * (y - a.y);
        worst_m = std::max(worst_m, largest_distance(&grid.height_m[grid.index(first, y)], last - first + 1,
                                                     first_m, plane.per_col));
        if (worst_m > enough_m) break;
    }
    return worst_m;
}

}  // namespace terrain
