// build_sparse_store: a store of a raster far too large to be held: level ground, and relief in some places.
//
// Pages that no patch is near are left out; one level page a group stands for them all (page_directory.h). The whole Earth at an
// arc second, 1,296,000 x 648,000 samples, takes 11 MB before there is any relief.
#pragma once

#include <functional>
#include <string>

#include "terrain/store/sparse_relief.h"
#include "terrain/store/store_builder.h"

namespace terrain {

/// Writes a store, whole or none. Heights are the relief's, errors bounds like a dense store's, never smaller than what
/// make_diamond_table finds. The result does not depend on the number of threads.
/// @param progress  called with the share that is done, in [0, 1], now and then; may be empty
/// Fails naming `path` when it cannot be written.
/// CHECKs that the patches lie in the raster and the raster in a domain of at most 2^kMostLog2Side cells a side.
/// Cost: O(levels * samples of the patches), and 13,000 diamonds for each of the 20 pages or so above a lone patch.
lod::Result<StoreReport> build_sparse_store(const SparseRelief& relief, const std::string& path,
                                            unsigned threads, const std::function<void(double)>& progress);

}  // namespace terrain
