#include "sim/paged_terrain.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/progress.h"

namespace sim {

bool names_store(const TerrainSource& source) {
    return std::any_of(source.sources.begin(), source.sources.end(), terrain::is_store);
}

lod::Result<PagedTerrain> open_paged_terrain(const TerrainSource& source, const terrain::RoamOptions& roam,
                                             bool waits) {
    if (source.sources.size() > 1) {
        return lod::Error{
            fmt::format("terrain: {} sources, one of them a terrain store; expected it to be the only one",
                        source.sources.size())};
    }
    if (roam.batch > 0) {
        return lod::Error{
            fmt::format("{}: --batch {}, expected 0: a patch's samples may lie in pages that are not here",
                        source.sources.front(), roam.batch)};
    }
    const Stopwatch watch;
    auto store = terrain::StoreFile::open(source.sources.front());
    if (!store) return store.error();
    auto ground = terrain::read_coarse_ground(*store, kMostGroundSamples);
    if (!ground) return ground.error();
    terrain::PageLoaderOptions loading;
    loading.memory_bytes = static_cast<uint64_t>(source.memory_mb * 1048576.0);
    loading.want_px = 0.5 * roam.tolerance_px;
    loading.waits = waits;
    loading.on_trouble = say_note;
    auto paged = terrain::open_paged_table(std::move(*store), loading);
    if (!paged) return paged.error();
    const terrain::StoreHeader& header = paged->loader->store().header();
    say_progress(
        fmt::format("terrain: {} x {} samples, {:.0f} to {:.0f} m, in {} pages, {} of them here for good; "
                    "the ground by every "
                    "{}th sample; opened in {:.1f} s",
                    header.width, header.height, header.min_m, header.max_m, header.entries.size(),
                    paged->loader->pinned_count(), ground->stride, watch.seconds()));
    PagedTerrain result;
    result.front =
        std::make_unique<terrain::RoamFront>(std::move(paged->table), roam, std::move(paged->loader));
    result.ground = std::move(*ground);
    return result;
}

}  // namespace sim
