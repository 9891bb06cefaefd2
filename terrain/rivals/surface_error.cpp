#include "terrain/rivals/surface_error.h"

#include <algorithm>
#include <cmath>

namespace terrain {
namespace {

int floor_div(int a, int b) {  // b > 0
    const int quotient = a / b;
    return quotient - (quotient * b > a ? 1 : 0);
}

/// Columns of one row that lie inside or on a triangle, exactly: products stay below 2^31 for 32769 samples a side.
struct RowSpan {
    int first = INT32_MAX, last = INT32_MIN;

    void cut(GridPoint p, GridPoint q, int y) {
        if (p.y > q.y) std::swap(p, q);
        if (y < p.y || y > q.y) return;
        if (p.y == q.y) {
            first = std::min({first, p.x, q.x});
            last = std::max({last, p.x, q.x});
            return;
        }
        const int height = q.y - p.y, along = (q.x - p.x) * (y - p.y);
        const int floor = floor_div(along, height);
        last = std::max(last, p.x + floor);
        first = std::min(first, p.x + floor + (floor * height < along ? 1 : 0));
    }
};

struct Plane {
    double base_m, per_col_m, per_row_m;
};

double max_residual_m(const data::HeightGrid& grid, const GridPoint corners[3], const Plane& plane) {
    const GridPoint a = corners[0], b = corners[1], c = corners[2];
    const int last_row = std::max({a.y, b.y, c.y});
    double worst = 0.0;
    for (int y = std::min({a.y, b.y, c.y}); y <= last_row; ++y) {
        RowSpan span;
        span.cut(a, b, y);
        span.cut(b, c, y);
        span.cut(c, a, y);
        const double row_m = plane.base_m + plane.per_row_m * (y - a.y);
        for (int x = span.first; x <= span.last; ++x) {
            const double plane_m = row_m + plane.per_col_m * (x - a.x);
            worst = std::max(worst, std::abs(double(grid.at(x, y)) - plane_m));
        }
    }
    return worst;
}

int64_t square(GridPoint a, GridPoint b) {
    const int64_t x = b.x - a.x, y = b.y - a.y;
    return x * x + y * y;
}

}  // namespace

float surface_error_m(const data::HeightGrid& grid, GridPoint a, GridPoint b, GridPoint c) {
    const int64_t area = twice_area(a, b, c);
    const int64_t longest2 = std::max({square(a, b), square(b, c), square(c, a)});
    const auto chord = grid.frame.chord_error_per_cell2();
    const bool is_curved = chord.up_m > 0.0 && longest2 > 2;
    const bool covers_more = area > 1 || area < -1;  // Pick: the corners only, else
    if (area == 0 || (!is_curved && !covers_more)) return 0.0f;

    const double a_m = double(grid.at(a.x, a.y));
    const double ab_m = double(grid.at(b.x, b.y)) - a_m, ac_m = double(grid.at(c.x, c.y)) - a_m;
    const double scale = 1.0 / static_cast<double>(area);
    const double abx = b.x - a.x, aby = b.y - a.y, acx = c.x - a.x, acy = c.y - a.y;
    const Plane plane{a_m, (ac_m * aby - ab_m * acy) * scale, (ab_m * acx - ac_m * abx) * scale};
    double error_m = 0.0;
    if (covers_more) {
        const GridPoint corners[3] = {a, b, c};
        error_m = max_residual_m(grid, corners, plane);
        if (error_m < 1e-9) error_m = 0.0;  // heights are floats: what is less is rounding
    }
    if (is_curved) {
        const glm::dvec2 cell = grid.frame.cell_m();
        const double slope = std::abs(plane.per_col_m) / cell.x + std::abs(plane.per_row_m) / cell.y;
        error_m += static_cast<double>(longest2) * (chord.up_m + slope * chord.side_m);
    }
    return static_cast<float>(error_m * (1.0 + 0x1p-20));
}

}  // namespace terrain
