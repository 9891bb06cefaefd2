// Ground texture: the colour of the land with its sunlight in it, one picture for the whole height grid.
//
// Light comes from the full-resolution relief, so it never changes with the level of detail of the mesh.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "data/height_grid.h"
#include "data/image.h"
#include "data/streets.h"
#include "lod/base/result.h"

namespace sim {

struct GroundTextureOptions {
    int detail_px = 4096;  ///< small grids are painted finer than their samples, up to this longer side
    int max_px = 8192;     ///< large grids are averaged down to this longer side
    unsigned threads = 2;  ///< changes nothing in the result
    std::span<const data::Street> streets{};  ///< painted over everything but imagery
};

/// Paints the ground; alpha says how much of a surface's fine structure shows (render::Renderer::set_detail). The image spans the grid's columns [-0.5, width - 0.5] and rows [-0.5, height - 0.5].
/// @param imagery  as data::read_imagery gives it, or an empty image; laid over the painting by its alpha
/// Cost: about 0.2 us per texel and thread.
data::Image paint_ground(const data::HeightGrid& grid, const data::Image& imagery,
                         const GroundTextureOptions& options);

}  // namespace sim
