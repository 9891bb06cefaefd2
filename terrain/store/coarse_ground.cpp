#include "terrain/store/coarse_ground.h"

#include <algorithm>

#include "terrain/store/page_tree.h"

namespace terrain {
namespace {

/// The grid without its samples.
lod::Result<CoarseGround> make_frame(const StoreHeader& header, int max_side) {
    CoarseGround ground;
    while ((std::max(header.width, header.height) - 1) / ground.stride + 1 > max_side)
        ground.stride *= 2;
    data::HeightGrid& grid = ground.grid;
    grid.width = (header.width - 1) / ground.stride + 1;
    grid.height = (header.height - 1) / ground.stride + 1;
    grid.min_m = header.min_m;
    grid.max_m = header.max_m;
    grid.height_m.assign(static_cast<size_t>(grid.width) * static_cast<size_t>(grid.height), header.level_m);
    if (header.has_voids) grid.is_void.resize(grid.height_m.size());
    // The first sample keeps its place: the corner of its pixel moves out.
    std::array<double, 6> place = header.geo_transform;
    const double out = 0.5 - 0.5 * ground.stride;
    place[0] += out * (place[1] + place[2]);
    place[3] += out * (place[4] + place[5]);
    for (size_t i : {1u, 2u, 4u, 5u})
        place[i] *= ground.stride;
    auto frame = data::GroundFrame::make(place, header.crs_wkt, grid.width, grid.height);
    if (!frame) return frame.error();
    grid.frame = std::move(*frame);
    return ground;
}

void put(CoarseGround& ground, GridPoint at, const DiamondSource& source) {
    const size_t index = ground.grid.index(at.x / ground.stride, at.y / ground.stride);
    ground.grid.height_m[index] = source.height_m;
    if (ground.grid.has_voids()) ground.grid.is_void[index] = source.is_void() ? 1 : 0;
}

}  // namespace

lod::Result<CoarseGround> read_coarse_ground(const StoreFile& store, int max_side) {
    CHECK(max_side >= 2);
    auto ground = make_frame(store.header(), max_side);
    if (!ground) return lod::Error{"terrain store '" + store.path() + "': " + ground.message()};
    const Domain domain = store.domain();
    for (int corner = 0; corner < 4; ++corner) {
        const GridPoint at{(corner & 1) * domain.side(), (corner >> 1) * domain.side()};
        if (domain.in_raster(at)) put(*ground, at, store.header().corners[static_cast<size_t>(corner)]);
    }
    std::vector<DiamondSource> facts(kPageEntries);
    const PageDirectory& directory = store.directory();
    for (size_t page = directory.level_count(); page < directory.count(); ++page) {
        const PageId id = directory.id(page);
        if (domain.reach(2 * id.group) < ground->stride) break;
        if (auto read = store.read_page(page, facts); !read) return read.error();
        for_each_diamond(domain, id, [&](GridPoint centre, int level) {
            const PagePlace place = store.layout().place(centre, level);
            if (place.page == directory.number(page)) put(*ground, centre, facts[place.entry]);
        });
    }
    return ground;
}

}  // namespace terrain
