// Ground texture: the colour of the land with its sunlight in it, one picture for the whole height grid.
//
// Light comes from the full-resolution relief, so it never changes with the level of detail of the mesh.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "data/height_grid.h"
#include "data/image.h"
#include "data/relief_edit.h"
#include "data/streets.h"
#include "lod/base/result.h"

namespace sim {

struct GroundTextureOptions {
    int detail_px = 4096;  ///< small grids are painted finer than their samples, up to this longer side
    int max_px = 8192;     ///< large grids are averaged down to this longer side
    unsigned threads = 2;  ///< changes nothing in the result
    std::span<const data::Street> streets{};  ///< painted over everything but imagery
};

/// Paints the ground; alpha says how much of a surface's fine structure shows (render::Renderer::set_detail). The image
/// spans the grid's columns [-0.5, width - 0.5] and rows [-0.5, height - 0.5].
/// @param imagery  as data::read_imagery gives it, or an empty image; laid over the painting by its alpha
/// Cost: about 0.2 us per texel and thread.
data::Image paint_ground(const data::HeightGrid& grid, const data::Image& imagery,
                         const GroundTextureOptions& options);

/// A rectangle of texels; empty to begin with.
struct TexelRect {
    int x = 0, y = 0, width = 0, height = 0;
};

/// Paints what an edit has changed: the range's texels and those its land may shade, by ground as low as the range's.
/// What the edit does to the prominence of the land around, and to shadows beyond, is not painted.
/// @param image    from paint_ground with the same arguments, before the edit
/// @param before   the samples that are others now, with their heights before
/// @returns the texels that may differ
/// Cost: about 0.2 us per texel and thread, and what measure_relief takes for the range.
TexelRect repaint_ground(const data::HeightGrid& grid, const data::Image& imagery,
                         const GroundTextureOptions& options, const data::HeightBlock& before,
                         data::Image& image);

}  // namespace sim
