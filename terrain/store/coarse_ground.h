// CoarseGround: every n-th sample of a store's raster as a grid of its own, for those who need all of the ground but
// not every detail of it: its colours, a drive along it, the feet of houses.
#pragma once

#include "data/height_grid.h"
#include "lod/base/result.h"
#include "terrain/store/store_file.h"

namespace terrain {

struct CoarseGround {
    data::HeightGrid grid;
    int stride = 1;  ///< sample (c, r) of the grid is sample (stride c, stride r) of the raster, exactly
};

/// The finest such grid whose longer side has at most `max_side` samples (>= 2); the stride is a power of two. What
/// lies beyond the last whole stride is left out. Samples that were filled count as measured.
/// Reads only the pages that hold those samples. Fails when one of them cannot be read.
lod::Result<CoarseGround> read_coarse_ground(const StoreFile& store, int max_side);

}  // namespace terrain
