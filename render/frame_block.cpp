#include "render/frame_block.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/surface_pattern.h"

namespace render {

namespace {

constexpr double kHazeScaleHeight_m = 2500.0;  ///< height over which haze thins to 1/e
constexpr double kSunRadius_rad = 0.0075;      ///< a little larger than the real disc: reads better
constexpr double kVisibleContrast = 0.05;      ///< what "visibility" means

Vec4 vec4_of(const glm::dvec3& v, double w) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

/// Tiles are counted from a sample near the eye, whole ones dropped in double: what is near the eye is as exact far
/// from the grid's corner as at it.
void place_ground(const Ground& ground, const glm::ivec2& sample, FrameBlock& block) {
    const glm::dvec2 per_sample = ground.detail.cell_m / kGroundTile_m;
    const glm::dvec2 anchor(sample), phase = glm::fract(anchor * per_sample);
    const glm::dvec2 grid(ground.grid_width, ground.grid_height);
    const glm::dvec2 scale = 1.0 / (per_sample * grid),
                     offset = (anchor + ground.lead) / grid - phase * scale;
    block.ground_tiles = vec4_of({per_sample, anchor.x}, anchor.y);
    block.ground_phase = vec4_of({phase, 0.0}, 0.0);
    block.ground_grid = vec4_of({scale, offset.x}, offset.y);
}

}  // namespace

FrameBlock frame_block_of(const lod::View& view, const Atmosphere& atmosphere, const Ground& ground,
                          int guard_ratio) {
    const double picture_share = 1.0 / guard_ratio;
    const lod::ViewMetric metric = lod::metric_of(view);
    const double extinction_per_m = -std::log2(kVisibleContrast) / std::max(atmosphere.visibility_m, 1.0);
    const double thinning_per_m = std::numbers::log2e / kHazeScaleHeight_m;
    const double eye_thinning = std::max(atmosphere.eye_height_m, 0.0) * thinning_per_m;

    FrameBlock block;
    block.projection = vec4_of({picture_share / metric.tan_x, picture_share / metric.tan_y, metric.near_m},
                               1.0 / metric.lambda_px);
    block.ray =
        vec4_of({2.0 * metric.tan_x / view.width_px, 2.0 * metric.tan_y / view.height_px, -metric.tan_x},
                -metric.tan_y);
    block.sun_eye = vec4_of(view.eye_from_world * atmosphere.sun_world, std::cos(kSunRadius_rad));
    block.up_eye = vec4_of(view.eye_from_world * atmosphere.up_world, picture_share);
    block.haze = vec4_of({extinction_per_m, thinning_per_m, eye_thinning}, std::exp2(-eye_thinning));
    place_ground(ground, atmosphere.ground_sample, block);
    return block;
}

}  // namespace render
