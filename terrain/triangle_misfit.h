// How far the samples under a bintree triangle are from its plane: exactly, and no further than one wants to know.
//
// The twin of terrain/triangle_error.h for a caller who compares with a limit instead of filling a table: double
// precision, no saturation, no rounding to a safe side, and most triangles that are too coarse say so in their
// first rows.
#pragma once

#include "data/height_grid.h"
#include "terrain/triangle_error.h"

namespace terrain {

/// The largest vertical distance of a covered sample, corners and sides included, from the triangle's plane.
///
/// Corners beyond the raster are clamped first; what is squeezed to nothing is 0. Voids: 0 when every covered
/// sample is void, infinite when some are.
/// @param enough_m  once a distance beyond this is met, it is returned without looking further
/// Accuracy: within 1e-12 of the largest height; exact where heights are multiples of 2^-12 m.
double triangle_misfit(const data::HeightGrid& grid, const Domain& domain, const TriangleCorners& corners,
                       double enough_m);

}  // namespace terrain
