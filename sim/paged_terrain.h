// Paged terrain: a [terrain] whose source is a terrain store is drawn from it page by page; what asks for the ground
// itself is answered from a coarser grid.
#pragma once

#include <memory>

#include "lod/base/result.h"
#include "sim/scene_file.h"
#include "terrain/roam_front.h"
#include "terrain/store/coarse_ground.h"

namespace sim {

/// What a store becomes.
struct PagedTerrain {
    std::unique_ptr<terrain::RoamFront> front;
    terrain::CoarseGround ground;  ///< at most kMostGroundSamples a side
};

inline constexpr int kMostGroundSamples = 4096;

/// Whether one of the sources is a terrain store, by what it begins with.
bool names_store(const TerrainSource& source);

/// Opens a store for drawing.
/// @param waits  each frame waits until all pages it wants are here: for runs that must repeat exactly
/// Fails when the store is not the only source, or not whole, or the limit of memory too small.
lod::Result<PagedTerrain> open_paged_terrain(const TerrainSource& source, const terrain::RoamOptions& roam,
                                             bool waits);

}  // namespace sim
