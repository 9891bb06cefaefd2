// extract: a static mesh of a height grid with a guaranteed error, for other programs.
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
    std::vector<Vertex> vertices;
    std::vector<std::array<uint32_t, 3>> triangles;  ///< counter-clockwise seen from above
    double max_error_m = 0.0;  ///< no sample is farther than this from the mesh, measured vertically
};

/// The coarsest conforming bintree mesh whose every triangle is within `max_error_m` of every sample it covers,
/// heights as the source has them (no curvature). 0 gives the full grid where it is not flat.
/// @param max_error_m  >= 0
/// Cost: O(n log n) for the errors, then O(triangles).
ExtractedMesh extract(const data::HeightGrid& grid, double max_error_m, unsigned threads);

}  // namespace terrain
