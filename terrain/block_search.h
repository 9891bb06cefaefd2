// Search for the worst sample of a triangle by blocks: no block is looked into whose heights cannot be farther from the
// plane than what has been found. Finds what a scan over all samples finds, to the bit, without looking at most.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "data/height_extremes.h"
#include "terrain/plane_rows.h"

namespace terrain {

/// A triangle with its corners on the grid, turned so that its inside is where the three cross products are >= 0.
class TriangleSides {
  public:
    TriangleSides(GridPoint a, GridPoint b, GridPoint c) : corners_{a, b, c} {
        if (cross(a, b, c) < 0) std::swap(corners_[1], corners_[2]);
    }

    /// False when no point of the rectangle lies in the triangle; may be true when none does.
    bool may_meet(const data::SampleRange& r) const {
        const auto [min_x, max_x] = std::minmax({corners_[0].x, corners_[1].x, corners_[2].x});
        const auto [min_y, max_y] = std::minmax({corners_[0].y, corners_[1].y, corners_[2].y});
        if (r.max.x < min_x || r.min.x > max_x || r.max.y < min_y || r.min.y > max_y) return false;
        for (size_t i = 0; i < 3; ++i) {
            if (side(i, r, true) < 0) return false;
        }
        return true;
    }
    bool contains(const data::SampleRange& r) const {
        return side(0, r, false) >= 0 && side(1, r, false) >= 0 && side(2, r, false) >= 0;
    }

  private:
    static int64_t cross(GridPoint p, GridPoint q, GridPoint at) {
        return int64_t(q.x - p.x) * (at.y - p.y) - int64_t(q.y - p.y) * (at.x - p.x);
    }
    /// Largest or smallest cross product of a side with a point of the rectangle.
    int64_t side(size_t i, const data::SampleRange& r, bool largest) const {
        const GridPoint p = corners_[i], q = corners_[(i + 1) % 3];
        const bool high_x = (q.y - p.y < 0) == largest, high_y = (q.x - p.x > 0) == largest;
        return cross(p, q, {high_x ? r.max.x : r.min.x, high_y ? r.max.y : r.min.y});
    }

    std::array<GridPoint, 3> corners_;
};

/// The samples of a block that lie in the grid.
inline data::SampleRange samples_of(const data::HeightGrid& grid, const data::HeightExtremes::Level& level,
                                    int col, int row) {
    const glm::ivec2 first = glm::ivec2(col, row) << level.shift;
    return data::common({first, first + ((1 << level.shift) - 1)}, data::range_of(grid));
}

/// A triangle's plane in double, for bounds.
struct SearchPlane {
    GridPoint apex;
    double apex_m = 0.0, gradient_x = 0.0, gradient_y = 0.0;  ///< metres, metres per column and row
};

/// One search; Rows as in plane_rows.h.
template <typename Rows>
class WorstSearch {
  public:
    WorstSearch(const data::HeightGrid& grid, const data::HeightExtremes& extremes,
                const TriangleSides& sides, const Rows& rows, const SearchPlane& plane)
        : grid_(grid), extremes_(extremes), sides_(sides), rows_(rows), plane_(plane) {}

    /// max |sample - plane| over the triangle's samples.
    float run() {
        visit(0, {0, 0});
        return worst_m_;
    }
    uint64_t samples() const { return samples_; }

  private:
    /// No sample of the block is farther from the plane; negative when none lies in the triangle.
    double bound_m(size_t level_index, glm::ivec2 at) const {
        const data::HeightExtremes::Level& level = extremes_.levels[level_index];
        const data::SampleRange r = samples_of(grid_, level, at.x, at.y);
        if (r.is_empty() || !sides_.may_meet(r)) return -1.0;
        const data::HeightExtremes::Block& block = level.blocks[level.index(at.x, at.y)];
        const double half_x = 0.5 * (r.max.x - r.min.x), half_y = 0.5 * (r.max.y - r.min.y);
        const double middle_m = plane_.apex_m + plane_.gradient_x * (r.min.x + half_x - plane_.apex.x) +
                                plane_.gradient_y * (r.min.y + half_y - plane_.apex.y);
        const double spread_m = std::abs(plane_.gradient_x) * half_x + std::abs(plane_.gradient_y) * half_y;
        const double low_m = double{block.min_m}, high_m = double{block.max_m};
        // The scan's plane is rounded to float a few times.
        const double scale_m = std::abs(plane_.apex_m) + std::abs(middle_m) + spread_m +
                               std::max(std::abs(low_m), std::abs(high_m)) +
                               std::abs(plane_.gradient_x) * grid_.width;
        return std::max(high_m - middle_m, middle_m - low_m) + spread_m + scale_m * 0x1p-20;
    }

    void visit(size_t level_index, glm::ivec2 at) {
        const data::HeightExtremes::Level& level = extremes_.levels[level_index];
        if (level_index + 1 == extremes_.levels.size()) return look(samples_of(grid_, level, at.x, at.y));
        struct Child {
            double bound_m = -1.0;
            glm::ivec2 at{0};
        };
        std::array<Child, 4> children;
        const data::HeightExtremes::Level& finer = extremes_.levels[level_index + 1];
        for (int i = 0; i < 4; ++i) {
            Child& child = children[static_cast<size_t>(i)];
            child.at = 2 * at + glm::ivec2(i & 1, i >> 1);
            if (child.at.x < finer.columns && child.at.y < finer.rows)
                child.bound_m = bound_m(level_index + 1, child.at);
        }
        std::stable_sort(children.begin(), children.end(),
                         [](const Child& a, const Child& b) { return a.bound_m > b.bound_m; });
        for (const Child& child : children) {
            if (child.bound_m > double{worst_m_}) visit(level_index + 1, child.at);
        }
    }

    void look(const data::SampleRange& r) {
        for (int y = std::max(r.min.y, rows_.first_y); y <= std::min(r.max.y, rows_.last_y); ++y) {
            SampleRow row;
            if (!rows_.at(y, row)) continue;
            const int first = std::max(r.min.x - row.x, 0), last = std::min(r.max.x - row.x, row.count - 1);
            if (first > last) continue;
            const float* samples = &grid_.height_m[grid_.index(row.x, y)];
            for (int i = first; i <= last; ++i) {
                worst_m_ = std::max(
                    worst_m_, std::abs(samples[i] - (row.first_m + rows_.gradient * static_cast<float>(i))));
            }
            samples_ += static_cast<uint64_t>(last - first + 1);
        }
    }

    const data::HeightGrid& grid_;
    const data::HeightExtremes& extremes_;
    const TriangleSides& sides_;
    const Rows& rows_;
    SearchPlane plane_;
    float worst_m_ = 0.0f;
    uint64_t samples_ = 0;
};

}  // namespace terrain
