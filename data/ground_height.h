// ground_height: the one surface that every question about the ground is asked of.
//
// The surface is the source data at full resolution: heights are linear over the two halves of each cell of the
// raster, cut along the diagonal that joins its even corners (column + row even), as the finest bintree triangles
// are. So the edges of its triangles are four families of lines, whole and even numbers:
//
//     +---+---+      column = i      column - row = 2i
//     | \ | / |      row = i         column + row = 2i
//     +---+---+
//     | / | \ |
//     +---+---+      Heights between are above the ellipsoid, along the vertical of each place.
//
// A triangle drawn at full resolution is flat in the world instead, so it hangs below by what its chords lose:
// at most 2 * GroundFrame::chord_error_per_cell2(), 0.2 mm at 90 m between samples; nothing without a datum.
// Nothing here knows of views, fronts or budgets: the same question has the same answer, to the bit.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "data/height_grid.h"

namespace data {

/// A triangle of the surface and a place in it: the cell's corner with the right angle, the corners next to it
/// along its row and its column, and the distances from it along both, in cells; in [0, 1], u + v <= 1.
struct HalfCell {
    glm::ivec2 corner{0}, along_row{0}, along_col{0};
    double u = 0.0, v = 0.0;
};

/// The triangle at a grid position inside the raster; either of two on an edge, always the same one.
HalfCell half_cell_at(const HeightGrid& grid, double col, double row);

/// Whether a grid position lies in the raster, the border included; NaN does not.
inline bool is_inside(const HeightGrid& grid, double col, double row) {
    return grid.width >= 2 && grid.height >= 2 && col >= 0.0 && row >= 0.0 && col <= grid.width - 1 &&
           row <= grid.height - 1;
}

/// Height of the surface, metres. Not valid outside the raster (then 0), and where a corner of the triangle is
/// void (then what is interpolated from the void's rim).
struct GroundHeight {
    double height_m = 0.0;
    bool valid = false;
};

/// At a grid position. Cost: about 10 ns. Continuous; exactly the sample's height at a sample.
GroundHeight ground_height(const HeightGrid& grid, double col, double row);

/// At or below a site, whose height counts for nothing. Cost: that, and grid_from_site.
GroundHeight ground_height(const HeightGrid& grid, const SitePoint& site);

/// Where the segment from `a` to `b`, grid positions, crosses the edges of the surface's triangles: fractions of its
/// length, inside (0, 1), ascending, none twice. `out` is cleared first.
void mesh_crossings(const glm::dvec2& a, const glm::dvec2& b, std::vector<double>& out);

}  // namespace data
