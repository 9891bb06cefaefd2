// write_store: a table filled in place in a file, with the directory that tells of it; whole or not there.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lod/base/result.h"
#include "terrain/diamond_table.h"

namespace terrain {

/// What was written.
struct StoreReport {
    uint64_t file_bytes = 0;
    size_t page_count = 0;  ///< level pages included
};

struct StoreDraft {
    DiamondTable table;             ///< no slots yet; its map is made anew
    std::vector<uint64_t> numbers;  ///< of the pages to hold (page_directory.h)
    float level_m = 0.0f;           ///< height of the ground that no page tells of
};

/// Writes to a temporary name beside `path` and renames it.
/// @param fill  fills the table's slots, [entry][kPageEntries], which are zeros in a mapped file
/// Fails naming `path` when it cannot be written, with room on disk asked for first.
lod::Result<StoreReport> write_store(StoreDraft draft, const std::string& path, unsigned threads,
                                     const std::function<void(DiamondTable&)>& fill);

}  // namespace terrain
