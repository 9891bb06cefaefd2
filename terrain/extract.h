// extract: a static mesh of a height grid with a guaranteed error, for other programs.
//
// Of all conforming bintree meshes over the grid whose every triangle is within the error, the smallest: start
// with two triangles and split only those that are too far from a sample they cover, with the splits that these
// force. Any mesh that is good enough contains every such split (a triangle that is too coarse cannot be left as
// it is in any of them), so nothing smaller is possible, and the order of the splits does not matter. Errors are
// not saturated: that a descendant would be worse is no reason to split.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "data/height_grid.h"

namespace terrain {

/// Vertices are samples of the source grid, untouched.
struct ExtractedMesh {
    struct Vertex {
        int col = 0, row = 0;
        float height_m = 0.0f;
    };
    std::vector<Vertex> vertices;                    ///< row by row from the north-west
    std::vector<std::array<uint32_t, 3>> triangles;  ///< counter-clockwise seen from above; Sierpinski order
    double max_error_m = 0.0;  ///< the largest vertical distance of a covered sample from the mesh, measured
};

/// The smallest conforming bintree mesh whose every triangle is within `max_error_m` of every sample it covers,
/// heights as the source has them (no curvature). 0 gives the full grid where it is not flat. No triangle touches
/// a void sample.
/// @param max_error_m  >= 0
/// CHECKs that the grid has at least 2 x 2 and at most 32769 x 32769 samples.
/// Cost: O(n log n) at worst, in practice a few looks at each sample: 0.3 to 7 s for 4097 x 4097 samples, by triangles.
ExtractedMesh extract(const data::HeightGrid& grid, double max_error_m);

}  // namespace terrain
