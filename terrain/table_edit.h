// table_edit: brings a table up to date with a grid whose heights have changed in a range, without looking at the rest.
//
// Finest level first: the diamonds whose triangles cover a changed sample are computed anew, and so is a parent whose
// error is, or was, a child's that changed. Small triangles are scanned; large ones, which cover the grid, are
// searched (block_search.h), since a plane moved by one corner moves against every sample.
#pragma once

#include "data/height_extremes.h"
#include "terrain/diamond_table.h"

namespace terrain {

/// What the grid has become.
struct GroundEdit {
    const data::HeightGrid& grid;          ///< with its new heights; voids are where they were
    const data::HeightExtremes& extremes;  ///< up to date
    data::SampleRange changed;             ///< inside the grid
};

/// The changed range on the domain: what is clamped onto its border has changed as well.
data::SampleRange changed_on_domain(const Domain& domain, const data::SampleRange& changed);

/// What it took.
struct TableEditCounts {
    uint64_t computed = 0;          ///< diamonds
    uint64_t changed = 0;           ///< of them, those whose facts are others now
    uint64_t searched_samples = 0;  ///< looked at in large triangles
};

/// Afterwards the table is, fact by fact, what make_diamond_table makes of the grid; min_m and max_m contain it.
/// @param threads  >= 1; changes nothing in the result
/// CHECKs that every page is present and the sizes fit.
/// Cost: O(changed samples + levels * what a search looks at), see docs/relief_edits.md.
TableEditCounts edit_table(const GroundEdit& edit, DiamondTable& table, unsigned threads);

}  // namespace terrain
