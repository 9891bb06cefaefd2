// Facts of the smallest diamonds, which are nearly all of a table: the same as own_facts, to the bit, several times as
// fast, because the compiler knows their corners.
#pragma once

#include "terrain/diamond_facts.h"

namespace terrain {

/// Whether small_facts knows a diamond: of the finest four levels, with all its samples in the raster, none void.
/// Cost: a few comparisons.
bool is_small(const FactsPass& pass, GridPoint centre);

/// own_facts of such a diamond.
DiamondSource small_facts(const FactsPass& pass, GridPoint centre);

}  // namespace terrain
