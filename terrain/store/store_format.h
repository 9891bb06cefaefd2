// The terrain store's file: a diamond table on disk, one page after the other, behind a header that knows them all.
//
//     0              preamble: name, version, checksum, sizes, the raster's place and extremes
//                    CRS as WKT
//                    directory: 16 bytes an entry; 8 bytes a page, its number, where some are left out
//                    zeros up to a multiple of 4096
//     header_bytes   entries as they lie in memory, in the directory's order (page_directory.h), nothing between them
//
// Little-endian. The header's checksum covers everything behind it up to the pages, a page's stands in the
// directory: whatever is cut, flipped or from elsewhere is told before it is used.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lod/base/result.h"
#include "terrain/diamond_source.h"
#include "terrain/page_layout.h"
#include "terrain/store/file_handle.h"

namespace terrain {

inline constexpr uint64_t kPageBytes = kPageEntries * sizeof(DiamondSource);
inline constexpr uint64_t kStoreAlignment_bytes = 4096;

/// What is known of an entry without reading it.
struct PageSummary {
    uint32_t checksum = 0;    ///< CRC-32 of its bytes
    uint16_t error_code = 0;  ///< decode_length: the largest error of what cannot be split without this page
    uint16_t unused = 0;
    float min_m = 0.0f, max_m = 0.0f;  ///< heights of its diamonds and of all below them
};
static_assert(sizeof(PageSummary) == 16);

/// All that a store holds besides its pages.
struct StoreHeader {
    int width = 0, height = 0;              ///< samples of the raster
    std::array<double, 6> geo_transform{};  ///< with crs_wkt what GroundFrame::make needs
    std::string crs_wkt;
    float min_m = 0.0f, max_m = 0.0f;
    bool has_voids = false;
    std::array<DiamondSource, 4> corners{};
    float level_m = 0.0f;              ///< height of the ground that no page tells of
    std::vector<uint64_t> numbers;     ///< of the pages held (page_directory.h)
    std::vector<PageSummary> entries;  ///< [PageDirectory::count()]

    uint64_t size_bytes() const;  ///< where the pages begin
};

/// The header's bytes, size_bytes() of them.
std::string pack_header(const StoreHeader& header);

/// Whether a file begins as a terrain store does, of whatever version.
bool is_store(const std::string& path);

/// Reads and checks a header and the file's length. @param path  for messages
/// Fails with one line on anything but a whole store of this version.
lod::Result<StoreHeader> read_header(const FileHandle& file, const std::string& path);

/// CRC-32 (the one of zlib, PNG and Ethernet).
uint32_t checksum_of(const void* bytes, size_t size_bytes);

}  // namespace terrain
