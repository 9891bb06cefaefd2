// Triangles of an OcclusionMap: small ones by the ten thousand, so three edges and four rows at a time.
#include <algorithm>
#include <cmath>

#include "lod/base/float4.h"
#include "lod/occlusion_map.h"

namespace lod {

namespace {

constexpr float kFarthest_px = 8192.0f;  ///< beyond, a float is coarser than the margin allows
constexpr float kNoLimit_px = 1e9f;
/// Boxes of smaller ones are not worth their time: they hide nothing that others would not, and where they cover a part of a
/// cell, it counts as far as the farthest of them.
constexpr float kLeastArea_px = 48.0f;

/// x of an edge over the rows of a picture; pixel centres stand at whole numbers.
struct Edge {
    Float4 at_first_row, per_row;  ///< the same in all lanes

    Float4 over(Float4 rows) const { return at_first_row + per_row * rows; }
};

/// The edge from the lowest corner to the highest, and the two of the other side from below. Pulled inwards by the margin;
/// no limit when no row crosses it.
struct Sides {
    Edge longest, lower, upper;
    bool is_right = false;  ///< the other side is the right one

    Sides(const PicturePoint& low, const PicturePoint& middle, const PicturePoint& high, float first_row) {
        const Float4 from_x{low.x_px, low.x_px, middle.x_px}, from_y{low.y_px, low.y_px, middle.y_px};
        const Float4 to_x{high.x_px, middle.x_px, high.x_px}, to_y{high.y_px, middle.y_px, high.y_px};
        const Float4 rise = to_y - from_y, none{};
        const Int4 is_crossed = rise > none;
        const Float4 slope = is_crossed ? (to_x - from_x) / (is_crossed ? rise : splat(1.0f)) : none;
        is_right = middle.x_px > low.x_px + slope[0] * (middle.y_px - low.y_px);
        const Float4 inwards = is_right ? Float4{1.0f, -1.0f, -1.0f, 0.0f} : Float4{-1.0f, 1.0f, 1.0f, 0.0f};
        constexpr auto kMargin = static_cast<float>(OcclusionMap::kMargin_px);
        const Float4 x = from_x + slope * (first_row + 0.5f - from_y) - 0.5f +
                         inwards * (kMargin * sqrt(1.0f + slope * slope));
        const Float4 at = is_crossed ? x : inwards * -kNoLimit_px;
        longest = {splat(at[0]), splat(slope[0])};
        lower = {splat(at[1]), splat(slope[1])};
        upper = {splat(at[2]), splat(slope[2])};
    }
};

/// First and one past the last pixel of four rows, whole numbers.
struct FourSpans {
    Float4 first = splat(kNoLimit_px), end{};

    /// Which of eight pixels from x on lie within, as eight bits a row.
    Int4 bits_from(Float4 x) const {
        const Float4 none{}, eight = splat(8.0f);
        const Float4 from = min(max(first - x, none), eight), to = min(max(end - x, none), eight);
        return from < to ? power_of_two(to) - power_of_two(from) : Int4{};
    }
};

/// Pixels inside of all eight rows, and those inside of any.
struct Reach {
    float first_of_all = 0.0f, end_of_all = 0.0f;
    float first_of_any = 0.0f, end_of_any = 0.0f;
};
Reach reach_of(const FourSpans (&spans)[2]) {
    const Float4 latest = max(spans[0].first, spans[1].first), soonest = min(spans[0].end, spans[1].end),
                 least = min(spans[0].first, spans[1].first), most = max(spans[0].end, spans[1].end);
    return {.first_of_all = std::max({latest[0], latest[1], latest[2], latest[3]}),
            .end_of_all = std::min({soonest[0], soonest[1], soonest[2], soonest[3]}),
            .first_of_any = std::min({least[0], least[1], least[2], least[3]}),
            .end_of_any = std::max({most[0], most[1], most[2], most[3]})};
}

/// Whole numbers, not below.
Float4 rounded_up(Float4 x) {
    const Float4 cut = __builtin_convertvector(__builtin_convertvector(x, Int4), Float4);
    return cut < x ? cut + 1.0f : cut;
}

}  // namespace

void OcclusionMap::add_triangle(const std::array<PicturePoint, 3>& corners) {
    const PicturePoint *low = &corners[0], *middle = &corners[1], *high = &corners[2];
    if (low->y_px > middle->y_px) std::swap(low, middle);
    if (middle->y_px > high->y_px) std::swap(middle, high);
    if (low->y_px > middle->y_px) std::swap(low, middle);
    const auto [left_px, right_px] = std::minmax({low->x_px, middle->x_px, high->x_px});
    if (!(std::max({-left_px, right_px, -low->y_px, high->y_px}) < kFarthest_px)) return;

    constexpr auto kMargin = static_cast<float>(kMargin_px), kSlack = static_cast<float>(kDepthSlack);
    const float lowest = std::max(low->y_px + kMargin - 0.5f, 0.0f),
                highest = std::min(high->y_px - kMargin - 0.5f, static_cast<float>(height_px_ - 1)),
                leftmost = std::max(left_px + kMargin - 0.5f, 0.0f),
                rightmost = std::min(right_px - kMargin - 0.5f, static_cast<float>(width_px_ - 1));
    if (!(lowest <= highest && leftmost <= rightmost)) return;
    if ((highest - lowest) * (rightmost - leftmost) < kLeastArea_px) return;
    const int first_row = static_cast<int>(std::ceil(lowest)), last_row = static_cast<int>(highest);
    const int first_column = static_cast<int>(leftmost) / 8, last_column = static_cast<int>(rightmost) / 8;
    const Sides sides(*low, *middle, *high, static_cast<float>(first_row));
    const float depth_m = std::max({low->depth_m, middle->depth_m, high->depth_m}) * (1.0f + kSlack);
    const Float4 none{}, width = splat(static_cast<float>(width_px_)),
                         last = splat(static_cast<float>(last_row - first_row));

    for (int cell_row = first_row / 8; cell_row <= last_row / 8; ++cell_row) {
        FourSpans spans[2];
        for (int half = 0; half < 2; ++half) {
            const int lowest_row = 8 * cell_row + 4 * half;
            if (lowest_row > last_row || lowest_row + 3 < first_row) continue;
            const Float4 rows = Float4{0.0f, 1.0f, 2.0f, 3.0f} + static_cast<float>(lowest_row - first_row);
            const Float4 along = sides.longest.over(rows), a = sides.lower.over(rows),
                         b = sides.upper.over(rows);
            const Float4 from = sides.is_right ? along : max(a, b), to = sides.is_right ? min(a, b) : along;
            const Int4 is_in = (rows >= none) & (rows <= last);
            // What is one past `to`, rounded down, is `to` + 1 rounded down.
            const Float4 end = min(max(to + 1.0f, none), width);
            spans[half].first = rounded_up(min(max(from, none), width));
            spans[half].end =
                is_in ? __builtin_convertvector(__builtin_convertvector(end, Int4), Float4) : none;
        }
        const size_t first_cell = size_t(cell_row) * size_t(columns_);
        const Reach reach = first_column + 2 < last_column
                                ? reach_of(spans)
                                : Reach{kNoLimit_px, 0.0f, leftmost, rightmost + 1.0f};
        const int last_of_row = std::min(last_column, static_cast<int>(reach.end_of_any - 1.0f) / 8);
        for (int column = std::max(first_column, static_cast<int>(reach.first_of_any) / 8);
             column <= last_of_row; ++column) {
            if (depth_m >= cells_[first_cell + size_t(column)].full_depth_m) continue;
            const auto x = static_cast<float>(8 * column);
            const bool is_full = x >= reach.first_of_all && x + 8.0f <= reach.end_of_all;
            const uint64_t bits =
                is_full ? ~uint64_t{0} : bytes_of(spans[0].bits_from(splat(x)), spans[1].bits_from(splat(x)));
            if (bits != 0) cover(column, cell_row, bits, depth_m);
        }
    }
}

}  // namespace lod
