// What a command's sources say, held whole: rasters joined as in a scene, or a terrain store.
#pragma once

#include <string>
#include <vector>

#include "data/height_grid.h"
#include "lod/base/result.h"

namespace sim {

/// Reads rasters (data::read_height_grid), or the samples of a store, which are those of the rasters it was made of. Of a store
/// `options` count for nothing: what became of voids was settled when it was built, and filled ones count as measured.
/// Fails when a store does not stand alone, cannot be read, or has more than 2^30 samples.
lod::Result<data::HeightGrid> read_relief(const std::vector<std::string>& sources,
                                          const data::HeightGridOptions& options);

}  // namespace sim
