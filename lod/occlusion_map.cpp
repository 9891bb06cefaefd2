#include "lod/occlusion_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lod/base/check.h"

namespace lod {

namespace {

constexpr double kLeastRows_px = 3.0;  ///< lower solids are left out: they cover no cell
constexpr uint64_t kAll = ~uint64_t{0};

/// Pixels first … last of one row of a cell, as bits of that row.
uint64_t row_bits(int first, int last) {
    return (uint64_t{0xff} << first) & (uint64_t{0xff} >> (7 - last));
}

/// A rectangle of a cell's pixels.
uint64_t rectangle_bits(int left, int right, int bottom, int top) {
    constexpr uint64_t kOnePerRow = 0x0101010101010101u;
    return (row_bits(left, right) * kOnePerRow) & (kAll << (8 * bottom)) & (kAll >> (8 * (7 - top)));
}

struct Outline {
    std::array<glm::dvec2, 2 * OcclusionMap::kMostCorners> corners;  ///< counter-clockwise
    size_t count = 0;
};

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Andrew's monotone chain. @param points  sorted in place
Outline outline_of(std::span<glm::dvec2> points) {
    std::sort(points.begin(), points.end(), [](const glm::dvec2& a, const glm::dvec2& b) {
        return a.x < b.x || (a.x == b.x && a.y < b.y);
    });
    Outline out;
    const auto add = [&out](const glm::dvec2& point, size_t kept) {
        while (out.count >= kept + 2 &&
               turn(out.corners[out.count - 2], out.corners[out.count - 1], point) <= 0.0)
            --out.count;
        out.corners[out.count++] = point;
    };
    for (const glm::dvec2& point : points)
        add(point, 0);
    const size_t lower = out.count - 1;
    for (size_t i = points.size() - 1; i-- > 0;)
        add(points[i], lower);
    --out.count;  // the first point again
    return out;
}

}  // namespace

void OcclusionMap::begin(const ViewMetric& metric, int width_px, int height_px) {
    metric_ = metric;
    width_px_ = width_px, height_px_ = height_px;
    columns_ = (width_px + 7) / 8, rows_ = (height_px + 7) / 8;
    cells_.assign(size_t(columns_) * size_t(rows_), {0, 0.0f, std::numeric_limits<float>::infinity()});
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column)
            cells_[size_t(row * columns_ + column)].covered = outside_of(column, row);
    }
    spans_.resize(size_t(rows_) * 8);
}

/// Pixels of a cell that lie beyond the picture's right or upper edge: nothing of them needs to be covered.
uint64_t OcclusionMap::outside_of(int column, int row) const {
    const int right = std::min(width_px_ - 8 * column, 8) - 1, top = std::min(height_px_ - 8 * row, 8) - 1;
    return ~rectangle_bits(0, right, 0, top);
}

void OcclusionMap::cover(int column, int row, uint64_t bits, float depth_m) {
    Cell& cell = cells_[size_t(row * columns_ + column)];
    if (depth_m >= cell.full_depth_m) return;
    if (bits == kAll) {
        cell.full_depth_m = depth_m;
        if (cell.part_depth_m < depth_m) return;  // what covers a part of it lies in front
    } else {
        cell.covered |= bits;
        cell.part_depth_m = std::max(cell.part_depth_m, depth_m);
        if (cell.covered != kAll) return;
        cell.full_depth_m = std::min(cell.full_depth_m, cell.part_depth_m);
    }
    cell.covered = outside_of(column, row);
    cell.part_depth_m = 0.0f;
}

/// Adds spans_[first_row … last_row] to the cells.
void OcclusionMap::fill(int first_row, int last_row, float depth_m) {
    for (int row = first_row / 8; row <= last_row / 8; ++row) {
        int left = width_px_, right = -1, inner_left = 0, inner_right = width_px_;
        for (int y = 8 * row; y < 8 * row + 8; ++y) {
            if (y < first_row || y > last_row) spans_[size_t(y)] = {};
            const Span& span = spans_[size_t(y)];
            inner_left = std::max(inner_left, span.first);
            inner_right = std::min(inner_right, span.last);
            if (span.first > span.last) continue;
            left = std::min(left, span.first);
            right = std::max(right, span.last);
        }
        for (int column = left / 8; column <= right / 8; ++column) {
            const int x = 8 * column;
            uint64_t bits = kAll;
            if (x < inner_left || x + 7 > inner_right) {
                bits = 0;
                for (int y = 0; y < 8; ++y) {
                    const Span& span = spans_[size_t(8 * row + y)];
                    const int first = std::max(span.first - x, 0), last = std::min(span.last - x, 7);
                    if (first <= last) bits |= row_bits(first, last) << (8 * y);
                }
            }
            if (bits != 0) cover(column, row, bits, depth_m);
        }
    }
}

void OcclusionMap::add_convex(std::span<const glm::dvec3> corners_eye) {
    CHECK(corners_eye.size() >= 3 && corners_eye.size() <= kMostCorners);
    std::array<glm::dvec2, kMostCorners> points;
    double depth_m = 0.0;
    for (size_t i = 0; i < corners_eye.size(); ++i) {
        const double depth = -corners_eye[i].z;
        if (!(depth > metric_.near_m)) return;
        depth_m = std::max(depth_m, depth);
        points[i] = glm::dvec2(corners_eye[i]) * (metric_.lambda_px / depth) +
                    0.5 * glm::dvec2(width_px_, height_px_);
    }
    const std::span<glm::dvec2> all = std::span(points).first(corners_eye.size());
    double low = points[0].y, high = low;
    for (const glm::dvec2& point : all)
        low = std::min(low, point.y), high = std::max(high, point.y);
    if (high - low < kLeastRows_px) return;
    const Outline outline = outline_of(all);
    if (outline.count < 3) return;
    const double last_y = height_px_ - 1;
    const int first_row = static_cast<int>(std::ceil(std::clamp(low + kMargin_px - 0.5, 0.0, last_y + 1.0)));
    const int last_row = static_cast<int>(std::floor(std::clamp(high - kMargin_px - 0.5, -1.0, last_y)));
    if (first_row > last_row) return;
    std::fill(spans_.begin() + first_row, spans_.begin() + last_row + 1, Span{0, width_px_ - 1});
    for (size_t i = 0; i < outline.count; ++i) {
        glm::dvec2 a = outline.corners[i], b = outline.corners[i + 1 == outline.count ? 0 : i + 1];
        if (a.y == b.y) continue;
        const bool is_right = b.y > a.y;
        if (!is_right) std::swap(a, b);
        const double slope = (b.x - a.x) / (b.y - a.y), margin = kMargin_px * std::sqrt(1.0 + slope * slope);
        const int from = std::max(first_row, static_cast<int>(std::floor(std::max(a.y - 0.5, -1.0)))),
                  to = std::min(last_row, static_cast<int>(std::ceil(std::min(b.y - 0.5, last_y + 1.0))));
        for (int y = from; y <= to; ++y) {
            // The edge's line: beyond its ends it only takes pixels away.
            const double x = a.x + slope * (y + 0.5 - a.y) - 0.5;
            Span& span = spans_[size_t(y)];
            if (is_right)
                span.last =
                    std::min(span.last, static_cast<int>(std::floor(std::clamp(x - margin, -1.0, 1e6))));
            else
                span.first =
                    std::max(span.first, static_cast<int>(std::ceil(std::clamp(x + margin, 0.0, 1e6))));
        }
    }
    fill(first_row, last_row, static_cast<float>(depth_m * (1.0 + kDepthSlack)));
}

bool OcclusionMap::hides(std::span<const glm::dvec3> corners_eye) const {
    glm::dvec2 low(1e30), high(-1e30);
    double near_m = 1e30;
    for (const glm::dvec3& corner : corners_eye) {
        const double depth = -corner.z;
        if (!(depth > metric_.near_m)) return false;
        near_m = std::min(near_m, depth);
        const glm::dvec2 at = glm::dvec2(corner) * (metric_.lambda_px / depth);
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const glm::dvec2 middle = 0.5 * glm::dvec2(width_px_, height_px_), size(width_px_, height_px_);
    low = glm::floor(glm::max(low + middle - kMargin_px, glm::dvec2(0.0)));
    high = glm::floor(glm::min(high + middle + kMargin_px, size - 1.0));
    if (!(low.x <= high.x && low.y <= high.y)) return false;
    return hides({int(low.x), int(high.x), int(low.y), int(high.y)}, static_cast<float>(near_m));
}

bool OcclusionMap::hides(const PixelRectangle& pixels, float nearest_m) const {
    const auto& [left, right, bottom, top] = pixels;
    for (int row = top / 8; row >= bottom / 8; --row) {  // what stands highest shows first
        for (int column = left / 8; column <= right / 8; ++column) {
            const Cell& cell = cells_[size_t(row * columns_ + column)];
            if (cell.full_depth_m < nearest_m) continue;
            const uint64_t asked =
                rectangle_bits(std::max(left - 8 * column, 0), std::min(right - 8 * column, 7),
                               std::max(bottom - 8 * row, 0), std::min(top - 8 * row, 7));
            if ((asked & ~cell.covered) != 0 || cell.part_depth_m >= nearest_m) return false;
        }
    }
    return true;
}

}  // namespace lod
