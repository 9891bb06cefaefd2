#include "terrain/rivals/rivals.h"

#include "lod/base/check.h"
#include "terrain/rivals/chunked_quadtree.h"
#include "terrain/rivals/geo_mipmap.h"
#include "terrain/rivals/roam_merge_only.h"
#include "terrain/rivals/vdpm.h"
#include "terrain/rivals/vipm_blocks.h"

namespace terrain {

bool can_make(Rival kind, const data::HeightGrid& grid) {
    return kind != Rival::kVdpm || grid.height_m.size() <= Vdpm::kMostSamples;
}

std::unique_ptr<RivalFront> make_rival(Rival kind, const data::HeightGrid& grid, const DiamondTable& table,
                                       const RivalOptions& options) {
    const int cells = options.block_cells;
    CHECK(cells >= 4 && cells <= 64 && options.threads >= 1);
    switch (kind) {
        case Rival::kChunkedQuadtree:
            return std::make_unique<ChunkedQuadtree>(grid, cells, options.threads);
        case Rival::kGeoMipmap:
            return std::make_unique<GeoMipmapFront>(grid, cells, options.threads);
        case Rival::kVipmBlocks:
            return std::make_unique<VipmBlocks>(grid, cells, options.threads);
        case Rival::kVdpm:
            return std::make_unique<Vdpm>(grid, options.tolerance_px);
        case Rival::kRoamMergeOnly:
            return std::make_unique<RoamMergeOnly>(table, options.tolerance_px);
        case Rival::kCount:
            break;
    }
    CHECK(false);
    return nullptr;
}

}  // namespace terrain
