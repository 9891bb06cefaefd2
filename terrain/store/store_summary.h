// What a store's directory says of its pages, from a table that has them all.
#pragma once

#include <vector>

#include "terrain/diamond_table.h"
#include "terrain/store/page_directory.h"
#include "terrain/store/store_format.h"

namespace terrain {

/// @param table    its slots hold the directory's entries in order
/// @param level_m  height of the ground where the directory lacks a page
/// The result does not depend on the number of threads.
std::vector<PageSummary> summarise(const DiamondTable& table, const PageDirectory& directory, float level_m,
                                   unsigned threads);

}  // namespace terrain
