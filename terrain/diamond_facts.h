// diamond_facts: one diamond's facts, from the samples its two triangles cover. What fills a table, and what brings one
// up to date, computes them here.
#pragma once

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

/// A diamond's facts; the error is that of its own two triangles, not saturated.
/// @param samples  null, or grows by how many samples a search looked at
DiamondSource own_facts(const FactsPass& pass, GridPoint centre, uint64_t* samples = nullptr);

/// The largest error code among the children, which must be in the table.
uint16_t error_code_below(const DiamondTable& table, GridPoint centre, int level);

/// Facts of the domain's corners.
void set_corners(const data::HeightGrid& grid, DiamondTable& table);

}  // namespace terrain
