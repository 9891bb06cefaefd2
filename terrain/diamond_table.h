// DiamondTable: what the source data says about every diamond: its height, its error, its rise, its voids. 8 bytes
// each.
//
// The error of a triangle is the true maximum of |sample - plane| over every sample it covers, measured along
// the local vertical, plus what straight chords lose on the curved Earth. The error of a diamond is the larger
// of its two triangles', saturated: never smaller than a descendant's. Nothing is accumulated, so it is as
// tight as a per-triangle bound can be.
//
// Facts lie in pages (page_layout.h): the front works on one place at a time, so what it needs next is near, and
// a page may be absent: a table can be a window onto a store larger than memory.
//
// Sources: Duchaineau et al. 1997 (wedgies, which accumulate; these do not); Lindstrom and Pascucci 2001 for the
// saturation and for laying levels out together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "data/height_grid.h"
#include "terrain/diamond.h"
#include "terrain/diamond_source.h"
#include "terrain/fact_memory.h"
#include "terrain/page_layout.h"
#include "terrain/page_map.h"

namespace terrain {

/// A table, or a window onto one.
struct DiamondTable {
    static constexpr uint32_t kAbsent = 0xffffffffu;

    Domain domain;
    PageLayout layout;
    data::GroundFrame frame;           ///< where the samples lie
    float min_m = 0.0f, max_m = 0.0f;  ///< heights
    bool has_voids = false;
    DiamondSource corners[4];  ///< height and void of the domain's corners: (0,0), (side,0), (0,side), …
    PageMap slot_of_page;      ///< [page] where it is; kAbsent: not here
    FactMemory slots;          ///< [slot][kPageEntries]

    /// A diamond's facts, null when their page is absent. The centre must be one of this level's.
    const DiamondSource* find(GridPoint centre, int level) const {
        const PagePlace place = layout.place(centre, level);
        const uint32_t slot = slot_of_page[place.page];
        return slot == kAbsent ? nullptr : &slots[size_t(slot) * kPageEntries + place.entry];
    }
    /// The same where the page is known to be present.
    const DiamondSource& at(GridPoint centre, int level) const {
        const PagePlace place = layout.place(centre, level);
        return slots[size_t(slot_of_page[place.page]) * kPageEntries + place.entry];
    }
};

/// Everything of a table but its pages, which are all absent.
DiamondTable make_table_frame(const data::HeightGrid& grid);

/// Fills every page of a table whose `slots` have room for all, page by page in order, and hold zeros. The result
/// does not depend on the number of threads.
/// @param table     from make_table_frame(grid)
/// @param progress  called before each level, finest first, with that level; may be empty
void fill_table(const data::HeightGrid& grid, DiamondTable& table, unsigned threads,
                const std::function<void(int level)>& progress);

/// The table of a grid. The result does not depend on the number of threads.
/// @param threads  >= 1
/// CHECKs that the grid has at least 2 x 2 and at most 32769 x 32769 samples.
/// Cost: O(n log n), under a second for 4097 x 4097 samples on two cores (terrain_bench).
DiamondTable make_diamond_table(const data::HeightGrid& grid, unsigned threads);

}  // namespace terrain
