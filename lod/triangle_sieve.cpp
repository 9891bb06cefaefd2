#include "lod/triangle_sieve.h"

#include <algorithm>
#include <limits>

namespace lod {

namespace {

PicturePoint point_of(Float4 corner) {
    return {corner[0], corner[1], corner[2]};
}

}  // namespace

void TriangleSieve::begin(const View& view, const Columns& own) {
    own_ = own;
    metric_ = metric_of(view);
    map_.begin(metric_, view.width_px, view.height_px);
    const float unlimited = std::numeric_limits<float>::max();
    last_pixel_ = Float4{static_cast<float>(view.width_px - 1), static_cast<float>(view.height_px - 1),
                         unlimited, unlimited};
}

/// As shaders/scene.vert does it; the margins make up for roundings.
void TriangleSieve::place(std::span<const Vertex> vertices, const Instance& instance) {
    if (corners_.size() < vertices.size()) corners_.resize(vertices.size());
    const auto& m = instance.eye_from_model;
    const Float4 columns[3] = {Float4{m[0][0], m[1][0], m[2][0], 0.0f},
                               Float4{m[0][1], m[1][1], m[2][1], 0.0f},
                               Float4{m[0][2], m[1][2], m[2][2], 0.0f}};
    const auto lambda_px = static_cast<float>(metric_.lambda_px), near_m = static_cast<float>(metric_.near_m);
    const Float4 middle = 0.5f * (last_pixel_ + 1.0f);
    for (size_t i = 0; i < vertices.size(); ++i) {
        Float4 eye{};
        for (int k = 0; k < 3; ++k) {
            const float near_eye = (vertices[i].position_hi[k] - instance.origin_hi[k]) +
                                   (vertices[i].position_lo[k] - instance.origin_lo[k]);
            eye += columns[k] * near_eye;
        }
        const float depth = -eye[2];
        Float4 at = eye * (lambda_px / std::max(depth, near_m)) + middle;
        at[2] = depth > near_m ? depth : -1.0f;
        corners_[i].at = at;
    }
}

void TriangleSieve::sift(std::span<const Vertex> vertices, std::span<const uint32_t> indices,
                         const Instance& instance, std::span<uint8_t> shows) {
    constexpr auto kMargin = static_cast<float>(OcclusionMap::kMargin_px),
                   kSlack = static_cast<float>(OcclusionMap::kDepthSlack);
    if (indices.empty()) return;
    const auto [least, most] = std::minmax_element(indices.begin(), indices.end());
    const uint32_t first_used = *least;
    place(vertices.subspan(first_used, *most - first_used + 1), instance);
    const auto corner = [&](size_t i) { return corners_[indices[i] - first_used].at; };
    const bool is_leftmost = own_.left_px == Columns{}.left_px;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        const Float4 a = corner(i), b = corner(i + 1), c = corner(i + 2);
        const Float4 low = min(min(a, b), c), high = max(max(a, b), c);
        if (low[2] < 0.0f) {  // reaches the eye
            if (is_leftmost) shows[i / 3] = 1;
            continue;
        }
        if (!own_.hold(0.5f * (low[0] + high[0]))) continue;
        // Pixels whose centres, at whole numbers, may lie inside.
        const Float4 first = max(low - (0.5f + kMargin), Float4{}),
                     last = min(high - (0.5f - kMargin), last_pixel_);
        if (!(first[0] <= last[0] && first[1] <= last[1])) continue;
        const Int4 cut = __builtin_convertvector(first, Int4);
        const Int4 from = cut - (__builtin_convertvector(cut, Float4) < first);
        const Int4 to = __builtin_convertvector(last, Int4);
        if (from[0] > to[0] || from[1] > to[1]) continue;
        if (map_.hides({from[0], to[0], from[1], to[1]}, low[2] * (1.0f - kSlack))) continue;
        shows[i / 3] = 1;
        map_.add_triangle({point_of(a), point_of(b), point_of(c)});
    }
}

}  // namespace lod
