// The methods that ROAM with enhMerge is compared with: their list, what each claims, and how to make one.
#pragma once

#include <array>
#include <memory>
#include <string_view>

#include "data/height_grid.h"
#include "terrain/diamond_table.h"
#include "terrain/rivals/rival_front.h"

namespace terrain {

enum class Rival : uint8_t { kChunkedQuadtree, kGeoMipmap, kVipmBlocks, kVdpm, kRoamMergeOnly, kCount };

/// How a method keeps the background from showing between its pieces.
enum class Seams : uint8_t {
    kConforming,  ///< every vertex on an edge is a corner on both sides: no gap exists
    kSkirts       ///< gaps exist, and vertical strips stand behind them
};

/// What a method claims; tests/terrain/rivals_*_test.cpp measure it.
struct RivalClaims {
    Rival kind = Rival::kCount;
    std::string_view name;  ///< snake_case, for tables
    Seams seams = Seams::kConforming;
};

inline constexpr std::array<RivalClaims, static_cast<size_t>(Rival::kCount)> kRivals = {{
    {Rival::kChunkedQuadtree, "chunked_quadtree", Seams::kSkirts},
    {Rival::kGeoMipmap, "geo_mipmap", Seams::kConforming},
    {Rival::kVipmBlocks, "vipm_blocks", Seams::kConforming},
    {Rival::kVdpm, "vdpm", Seams::kConforming},
    {Rival::kRoamMergeOnly, "roam_merge_only", Seams::kConforming},
}};

struct RivalOptions {
    double tolerance_px = 1.0;  ///< what the scheduler will ask for
    unsigned threads = 2;       ///< of the preparation, >= 1; the result does not depend on it
    int block_cells = 32;       ///< along a block's or a chunk's side: 4 … 64, a power of two
};

/// Whether a method can be prepared for a grid of this size.
bool can_make(Rival kind, const data::HeightGrid& grid);

/// Prepares a method for one grid; its coarsest mesh. What it costs is what this call takes.
/// @param grid   must outlive the front
/// @param table  of the same grid; read by the variants of ROAM only
std::unique_ptr<RivalFront> make_rival(Rival kind, const data::HeightGrid& grid, const DiamondTable& table,
                                       const RivalOptions& options);

}  // namespace terrain
