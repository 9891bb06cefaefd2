// Fractal relief: seeded, the same on every machine; what methods are compared on beside real rasters.
#pragma once

#include "data/height_grid.h"

namespace data {

/// Midpoint displacement on (2^k + 1)^2 samples, cut to width x height; a planar grid without CRS.
/// @param relief_m  the first displacement is at most half of it, each finer one half of the one before
/// Cost: about 30 ns a sample.
HeightGrid fractal_grid(int width, int height, double spacing_m, double relief_m, uint64_t seed);

}  // namespace data
