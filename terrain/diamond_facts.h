// diamond_facts: one diamond's facts, from the samples its two triangles cover. What fills a table, and what brings one
// up to date, computes them here.
#pragma once

#include <cmath>

#include "terrain/diamond_table.h"
#include "terrain/triangle_error.h"

namespace terrain {

/// What every diamond of one level shares.
struct FactsPass {
    const data::HeightGrid& grid;
    const Domain& domain;
    int level = 0;
    int reach = 0;
    double cells = 0.0;  ///< longest edge of the level's triangles, in cells
    const data::HeightExtremes* extremes =
        nullptr;  ///< of the grid: search large triangles; null: scan them all
};
FactsPass make_facts_pass(const data::HeightGrid& grid, const Domain& domain, int level);

/// What straight chords of one triangle lose on the curved Earth, metres; 0 on planar grids.
inline float chord_error_m(const FactsPass& pass, const TriangleError& plane) {
    const auto chord = pass.grid.frame.chord_error_per_cell2();
    if (!(chord.up_m > 0.0)) return 0.0f;
    const glm::dvec2 cell = pass.grid.frame.cell_m();
    const double slope =
        std::abs(double(plane.gradient_x)) / cell.x + std::abs(double(plane.gradient_y)) / cell.y;
    return static_cast<float>(pass.cells * pass.cells * (chord.up_m + slope * chord.side_m));
}

/// A diamond's facts; the error is that of its own two triangles, not saturated.
/// @param samples  null, or grows by how many samples a search looked at
DiamondSource own_facts(const FactsPass& pass, GridPoint centre, uint64_t* samples = nullptr);

/// The largest error code among the children, which must be in the table.
uint16_t error_code_below(const DiamondTable& table, GridPoint centre, int level);

/// Facts of the domain's corners.
void set_corners(const data::HeightGrid& grid, DiamondTable& table);

}  // namespace terrain
