// How far samples are from a triangle whose corners are samples themselves: one text for a scan of all of them, for a
// search, and for the smallest triangles, whose corners the compiler knows.
#pragma once

#include <algorithm>
#include <cmath>

#include "terrain/plane_rows.h"
#include "terrain/triangle_error.h"

namespace terrain {

/// A bound on rounding: heights of `scale_m` metres through four float operations. Exact residuals stay exact.
inline float with_rounding(float residual_m, float scale_m) {
    constexpr float kRoundingShare = 4.0f * 0x1p-24f;  // of the largest height involved
    return residual_m == 0.0f ? 0.0f : residual_m + scale_m * kRoundingShare;
}

/// How far the sample between two corners, two cells apart along each axis they differ in, is from their mean.
template <typename Heights>
[[gnu::always_inline]] inline float sagitta(const Heights& heights, GridPoint p, float p_m, GridPoint q,
                                            float q_m) {
    return std::abs(heights.at((p.x + q.x) / 2, (p.y + q.y) / 2) - 0.5f * (p_m + q_m));
}

/// @param heights   at(x, y) is a sample's height, metres
/// @param t         corners with samples
/// @param worst_of  (corners, rows of plane_rows.h) to max |sample - plane|
template <typename Heights, typename WorstOf>
[[gnu::always_inline]] inline TriangleError regular_error(const Heights& heights, const TriangleCorners& t,
                                                          const WorstOf& worst_of) {
    const float a = heights.at(t.apex.x, t.apex.y);
    const float l = heights.at(t.left.x, t.left.y), r = heights.at(t.right.x, t.right.y);
    const float scale = std::max({std::abs(a), std::abs(l), std::abs(r)});
    // Gradients along x and y in metres per cell; divisions by powers of two are exact.
    float gx, gy, worst;
    if (t.left.x != t.right.x && t.left.y != t.right.y) {
        const bool left_on_x = t.left.y == t.apex.y;
        const GridPoint on_x = left_on_x ? t.left : t.right, on_y = left_on_x ? t.right : t.left;
        gx = ((left_on_x ? l : r) - a) / static_cast<float>(on_x.x - t.apex.x);
        gy = ((left_on_x ? r : l) - a) / static_cast<float>(on_y.y - t.apex.y);
        // Three quarters of all diamonds are of the two finest levels: their few samples lie on the sides.
        worst =
            std::abs(on_x.x - t.apex.x) == 2
                ? std::max({sagitta(heights, t.left, l, t.right, r), sagitta(heights, t.apex, a, t.left, l),
                            sagitta(heights, t.apex, a, t.right, r)})
                : worst_of(t, LegRows(t, {t.apex, a, gx, gy}));
    } else if (t.left.y == t.right.y) {
        gx = (r - l) / static_cast<float>(t.right.x - t.left.x);
        gy = (a - 0.5f * (l + r)) / static_cast<float>(t.apex.y - t.left.y);
        worst = std::abs(t.apex.y - t.left.y) == 1 ? sagitta(heights, t.left, l, t.right, r)
                                                   : worst_of(t, HypotenuseRows(t, {t.apex, a, gx, gy}));
    } else {
        gy = (r - l) / static_cast<float>(t.right.y - t.left.y);
        gx = (a - 0.5f * (l + r)) / static_cast<float>(t.apex.x - t.left.x);
        worst = std::abs(t.apex.x - t.left.x) == 1 ? sagitta(heights, t.left, l, t.right, r)
                                                   : worst_of(t, HypotenuseRows(t, {t.apex, a, gx, gy}));
    }
    return {with_rounding(worst, scale), gx, gy};
}

}  // namespace terrain
