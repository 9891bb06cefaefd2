// build_store: turns a grid of heights into a terrain store on disk, in place: memory is what the heights take.
#pragma once

#include <functional>
#include <string>

#include "data/height_grid.h"
#include "lod/base/result.h"
#include "terrain/store/store_writer.h"

namespace terrain {

/// Writes the table of a grid, bit for bit make_diamond_table's, to a temporary name beside `path` and renames it:
/// there is a whole store or none. The result does not depend on the number of threads.
/// @param progress  called with the share that is done, in [0, 1], now and then; may be empty
/// Fails naming `path` when it cannot be written, with room on disk asked for first.
/// CHECKs that the grid has at least 2 x 2 and at most 32769 x 32769 samples.
/// Cost: that of make_diamond_table and of writing 8.3 bytes a sample of the domain.
lod::Result<StoreReport> build_store(const data::HeightGrid& grid, const std::string& path, unsigned threads,
                                     const std::function<void(double)>& progress);

}  // namespace terrain
