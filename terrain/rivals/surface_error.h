// surface_error_m: how far the source samples are from one drawn triangle with its corners on any samples.
#pragma once

#include "data/height_grid.h"
#include "terrain/diamond.h"

namespace terrain {

/// Twice the signed area in cells^2; positive when counter-clockwise seen from above (rows run south).
inline int64_t twice_area(GridPoint a, GridPoint b, GridPoint c) {
    return int64_t{c.x - a.x} * (b.y - a.y) - int64_t{b.x - a.x} * (c.y - a.y);
}

/// Upper bound, metres along the local vertical: the exact maximum of |sample - plane| over every sample the
/// triangle covers, border included, plus what chords lose on the curved Earth (terrain/diamond_table.h). Zero for
/// an empty triangle and for half a cell, which is the source surface itself.
/// Cost: O(covered samples and rows), about 15 ns when no sample but the corners is covered.
float surface_error_m(const data::HeightGrid& grid, GridPoint a, GridPoint b, GridPoint c);

}  // namespace terrain
