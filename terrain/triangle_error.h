// The largest distance of height samples from the plane of one bintree triangle: the kernel of DiamondTable.
#pragma once

#include "data/height_extremes.h"
#include "data/height_grid.h"
#include "terrain/diamond.h"

namespace terrain {

/// Corners in the domain, possibly beyond the raster.
struct TriangleCorners {
    GridPoint apex, left, right;  ///< left and right end the hypotenuse
};

/// Residual and plane of one triangle over a height grid.
struct TriangleError {
    float residual_m = 0.0f;  ///< max |sample - plane| over every covered sample, vertical; an upper bound
    float gradient_x = 0.0f;  ///< of the plane, metres per column
    float gradient_y = 0.0f;  ///< metres per row
};

/// For a triangle that lies inside the raster: plane gradients are exact, rows are contiguous.
TriangleError regular_triangle_error(const data::HeightGrid& grid, const TriangleCorners& corners);

/// For a triangle that reaches beyond the raster: its corners are clamped first. Zero when nothing is left.
TriangleError clamped_triangle_error(const data::HeightGrid& grid, const Domain& domain,
                                     const TriangleCorners& corners);

/// max over i in [0, count) of |samples[i] - (first + gradient * i)|. Vectorised; the scalar twin is in the test.
float max_residual(const float* samples, int count, float first, float gradient);

/// What kinds of samples a triangle covers.
struct VoidCover {
    bool any_valid = false;
    bool any_void = false;
};
VoidCover void_cover(const data::HeightGrid& grid, const Domain& domain, const TriangleCorners& corners);

/// A grid and what a search skips by.
struct SearchedGround {
    const data::HeightGrid& grid;
    const data::HeightExtremes& extremes;  ///< of the grid as it is
};

/// What the functions above say, to the bit, found by a search instead of a scan (block_search.h): for triangles that
/// cover many samples. @param samples  grows by how many were looked at
TriangleError find_triangle_error(const SearchedGround& ground, const Domain& domain,
                                  const TriangleCorners& corners, uint64_t& samples);
VoidCover find_void_cover(const SearchedGround& ground, const Domain& domain, const TriangleCorners& corners);

}  // namespace terrain
