// StoreFile: an open terrain store: its header in memory, its pages on disk.
#pragma once

#include <span>
#include <string>

#include "data/ground_frame.h"
#include "lod/base/result.h"
#include "terrain/diamond_table.h"
#include "terrain/store/page_directory.h"
#include "terrain/store/store_format.h"

namespace terrain {

/// Move-only. The open file stays what it was when another is renamed over its path.
class StoreFile {
  public:
    /// Reads and checks the header; no page is touched. Fails with one line (store_format.h).
    static lod::Result<StoreFile> open(const std::string& path);

    const std::string& path() const { return path_; }
    const StoreHeader& header() const { return header_; }
    const PageLayout& layout() const { return directory_.layout(); }
    const PageDirectory& directory() const { return directory_; }
    Domain domain() const { return make_domain(header_.width, header_.height); }

    /// The table without any page and without slots. Level pages are expected in the slots of their entries.
    DiamondTable make_table() const;

    /// The table with all pages, the file itself mapped into memory. Pages are not checked, and a file that is cut
    /// while mapped ends the program: for measurements and tools. Fails when the system refuses.
    lod::Result<DiamondTable> map_table() const;

    /// Copies one entry out of the file and checks it; plain reads, so a file that was cut meanwhile is an error and
    /// no signal. Safe to call from several threads. Fails naming the page.
    /// @param out  kPageEntries
    lod::Result<lod::Ok> read_page(size_t entry, std::span<DiamondSource> out) const;

  private:
    StoreFile(std::string path, FileHandle file, StoreHeader header, data::GroundFrame frame);

    std::string path_;
    FileHandle file_;
    StoreHeader header_;
    data::GroundFrame frame_;
    PageDirectory directory_;
};

}  // namespace terrain
