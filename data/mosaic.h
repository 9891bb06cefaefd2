// Joining several height rasters on the grid of the first.
#pragma once

#include <vector>

#include "data/height_raster.h"
#include "lod/base/result.h"

namespace data {

/// One raster over the ground of all: spacing, CRS and phase of the first. Where several have a valid sample the
/// first listed wins. A source whose samples fall on the grid (within 1/50 cell) is copied, any other resampled:
/// bilinearly over its valid samples, void where its nearest sample is void. Ground without a source is void.
///
///     first  . . . .                 a source covers its pixels' areas: half a cell around its samples, so
///            . . . . : : :           pixel-is-area neighbours meet, and tiles that share an edge row agree
///            . . . . : : :
///
/// @param rasters  at least one; consumed
/// Fails when one has a CRS and another none, when a place cannot be computed, or beyond 2^30 samples.
lod::Result<HeightRaster> join(std::vector<HeightRaster> rasters);

}  // namespace data
