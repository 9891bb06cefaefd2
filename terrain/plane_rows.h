// Rows of samples a bintree triangle covers, with its plane along each: what a scan over all of them and a search for
// the worst share, so that both say the same to the bit.
//
//     Rows has     first_y, last_y, gradient     rows there may be; the plane's rise per column
//                  bool at(y, SampleRow&)        false when no sample of this row lies in the triangle
#pragma once

#include <algorithm>
#include <cmath>

#include "data/height_grid.h"
#include "terrain/triangle_error.h"
#include "terrain/triangle_rows.h"

namespace terrain {

/// Samples x … x + count - 1; the plane is first_m + gradient * i over the i-th of them.
struct SampleRow {
    int x = 0, count = 0;
    float first_m = 0.0f;
};

/// A plane through a triangle's apex.
struct ApexPlane {
    GridPoint apex;
    float apex_m = 0.0f, gradient_x = 0.0f, gradient_y = 0.0f;
};

/// A square-type triangle: legs along the axes from the apex.
struct LegRows {
    LegRows(const TriangleCorners& t, const ApexPlane& plane_through)
        : plane(plane_through),
          legs(std::abs(t.left.x + t.right.x - 2 * t.apex.x)),  // one of the two legs is along x
          is_east(t.left.x + t.right.x > 2 * t.apex.x),
          gradient(plane_through.gradient_x),
          first_y(std::min(t.left.y, t.right.y)),
          last_y(std::max(t.left.y, t.right.y)) {}

    bool at(int y, SampleRow& row) const {
        const int beyond = std::abs(y - plane.apex.y);
        row.x = is_east ? plane.apex.x : plane.apex.x - (legs - beyond);
        row.count = legs - beyond + 1;
        row.first_m = plane.apex_m + plane.gradient_y * static_cast<float>(y - plane.apex.y) +
                      plane.gradient_x * static_cast<float>(row.x - plane.apex.x);
        return true;
    }

    ApexPlane plane;
    int legs;
    bool is_east;
    float gradient;
    int first_y, last_y;
};

/// A turned triangle: hypotenuse along x (rows shrink towards the apex) or along y (rows grow to the middle).
struct HypotenuseRows {
    HypotenuseRows(const TriangleCorners& t, const ApexPlane& plane_through)
        : plane(plane_through),
          middle{(t.left.x + t.right.x) / 2, (t.left.y + t.right.y) / 2},
          is_along_x(t.left.y == t.right.y),
          is_east(t.apex.x > middle.x),
          height(is_along_x ? std::abs(t.apex.y - middle.y) : std::abs(t.apex.x - middle.x)),
          gradient(plane_through.gradient_x),
          first_y(std::min({t.apex.y, t.left.y, t.right.y})),
          last_y(std::max({t.apex.y, t.left.y, t.right.y})) {}

    bool at(int y, SampleRow& row) const {
        const int reach = height - std::abs(y - middle.y);
        row.x = is_along_x || !is_east ? middle.x - reach : middle.x;
        row.count = is_along_x ? 2 * reach + 1 : reach + 1;
        row.first_m = plane.apex_m + plane.gradient_y * static_cast<float>(y - plane.apex.y) +
                      plane.gradient_x * static_cast<float>(row.x - plane.apex.x);
        return true;
    }

    ApexPlane plane;
    GridPoint middle;
    bool is_along_x, is_east;
    int height;
    float gradient;
    int first_y, last_y;
};

/// A triangle whose clamped corners lie anywhere.
struct ClampedRows {
    ClampedRows(const RowSpans& spans_of, GridPoint apex_at, double apex_height_m,
                const glm::dvec2& plane_gradient)
        : spans(spans_of),
          apex(apex_at),
          apex_m(apex_height_m),
          slope(plane_gradient),
          gradient(static_cast<float>(plane_gradient.x)),
          first_y(spans_of.first_row()),
          last_y(spans_of.last_row()) {}

    bool at(int y, SampleRow& row) const {
        int x = 0, x_last = 0;
        if (!spans.span(y, x, x_last)) return false;
        row.x = x;
        row.count = x_last - x + 1;
        row.first_m = static_cast<float>(apex_m + slope.x * (x - apex.x) + slope.y * (y - apex.y));
        return true;
    }

    RowSpans spans;
    GridPoint apex;
    double apex_m;
    glm::dvec2 slope;
    float gradient;
    int first_y, last_y;
};

}  // namespace terrain
