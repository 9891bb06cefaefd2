// Which samples a triangle on the grid covers, row by row.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "terrain/diamond.h"

namespace terrain {

/// Rows of a triangle with any corners on the grid: for each y the range of x inside or on the border.
class RowSpans {
  public:
    RowSpans(GridPoint a, GridPoint b, GridPoint c) : corners_{a, b, c} {}

    int first_row() const { return std::min({corners_[0].y, corners_[1].y, corners_[2].y}); }
    int last_row() const { return std::max({corners_[0].y, corners_[1].y, corners_[2].y}); }

    /// False when no sample of this row lies in the triangle.
    bool span(int y, int& x_begin, int& x_last) const {
        double low = 1e30, high = -1e30;
        for (int i = 0; i < 3; ++i) {
            const GridPoint p = corners_[i], q = corners_[(i + 1) % 3];
            if (y < std::min(p.y, q.y) || y > std::max(p.y, q.y)) continue;
            if (p.y == q.y) {
                low = std::min<double>({low, double(p.x), double(q.x)});
                high = std::max<double>({high, double(p.x), double(q.x)});
                continue;
            }
            const double x = p.x + double(q.x - p.x) * (y - p.y) / (q.y - p.y);
            low = std::min(low, x);
            high = std::max(high, x);
        }
        x_begin = static_cast<int>(std::ceil(low - 1e-9));
        x_last = static_cast<int>(std::floor(high + 1e-9));
        return x_begin <= x_last;
    }

  private:
    GridPoint corners_[3];
};

inline bool is_degenerate(GridPoint a, GridPoint b, GridPoint c) {
    return int64_t(b.x - a.x) * (c.y - a.y) == int64_t(c.x - a.x) * (b.y - a.y);
}

}  // namespace terrain
