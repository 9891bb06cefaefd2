#include "terrain/store/store_builder.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "lod/base/parallel.h"
#include "terrain/diamond_table.h"
#include "terrain/store/page_tree.h"
#include "terrain/store/store_format.h"

namespace terrain {
namespace {

struct HeightRange {
    float min_m = std::numeric_limits<float>::infinity();
    float max_m = -std::numeric_limits<float>::infinity();

    void add(const DiamondSource& source) {
        min_m = std::min(min_m, source.height_m);
        max_m = std::max(max_m, source.height_m);
    }
};

/// Heights in and below a page; those below are known by `pages`.
HeightRange heights_of(const DiamondTable& table, size_t page, const std::vector<PageSummary>& pages) {
    const PageId id = table.layout.id(page);
    HeightRange range;
    for_each_diamond(table.domain, id,
                     [&](GridPoint centre, int level) { range.add(table.at(centre, level)); });
    for_each_child(table.layout, id, [&](const PageId& child) {
        const PageSummary& below = pages[table.layout.number(child)];
        range.min_m = std::min(range.min_m, below.min_m);
        range.max_m = std::max(range.max_m, below.max_m);
    });
    if (range.min_m > range.max_m) range = {table.min_m, table.max_m};  // beyond the raster
    return range;
}

/// The largest error of a diamond one level above the page whose children may lie in it. Those that have none but
/// turned ones there, at its rim, are children of such.
uint16_t error_without(const DiamondTable& table, const PageId& id) {
    if (id.group == 0) return std::numeric_limits<uint16_t>::max();
    const Domain& domain = table.domain;
    const int level = 2 * id.group - 1, reach = domain.reach(level);
    const int width = domain.reach(2 * id.group) * 2 * kPageSide;
    const GridPoint first{id.block_x * width - reach, id.block_y * width - reach};
    uint16_t worst = 0;
    for (int y = std::max(first.y, 0); y <= std::min(first.y + width + 2 * reach, domain.side());
         y += reach) {
        for (int x = std::max(first.x, 0); x <= std::min(first.x + width + 2 * reach, domain.side());
             x += reach) {
            if (((x / reach ^ y / reach) & 1) != 0)
                worst = std::max(worst, table.at({x, y}, level).error_code);
        }
    }
    return worst;
}

/// Finest group first: a page's summary needs those of its children.
std::vector<PageSummary> summarise(const DiamondTable& table, unsigned threads) {
    const PageLayout& layout = table.layout;
    std::vector<PageSummary> pages(layout.page_count());
    for (int group = layout.group_count() - 1; group >= 0; --group) {
        const size_t first = layout.number({group, 0, 0});
        const size_t count =
            static_cast<size_t>(layout.blocks(group)) * static_cast<size_t>(layout.blocks(group));
        lod::parallel_for(count, threads, [&](size_t begin, size_t end) {
            for (size_t page = first + begin; page < first + end; ++page) {
                const HeightRange range = heights_of(table, page, pages);
                pages[page].checksum = checksum_of(&table.slots[page * kPageEntries], kPageBytes);
                pages[page].error_code = error_without(table, layout.id(page));
                pages[page].min_m = range.min_m;
                pages[page].max_m = range.max_m;
            }
        });
    }
    return pages;
}

StoreHeader make_header(const data::HeightGrid& grid, const DiamondTable& table) {
    StoreHeader header;
    header.width = grid.width;
    header.height = grid.height;
    header.geo_transform = grid.frame.geo_transform();
    header.crs_wkt = grid.frame.crs_wkt();
    header.min_m = table.min_m;
    header.max_m = table.max_m;
    header.has_voids = table.has_voids;
    std::copy(table.corners, table.corners + 4, header.corners.begin());
    header.pages.resize(table.layout.page_count());
    return header;
}

/// Fills the file at its temporary place. Returns what went wrong; empty when nothing did.
std::string write_store(const data::HeightGrid& grid, const FileHandle& file, unsigned threads,
                        const std::function<void(double)>& progress) {
    DiamondTable table = make_table_frame(grid);
    StoreHeader header = make_header(grid, table);
    const uint64_t file_bytes = header.size_bytes() + header.pages.size() * kPageBytes;
    if (!file.reserve(file_bytes))
        return "cannot be given its " + std::to_string(file_bytes) + " bytes, expected room on disk";
    table.slots =
        FactMemory::of_file(file.get(), header.size_bytes(), header.pages.size() * kPageEntries, true);
    if (table.slots.size() == 0) return "cannot be mapped, expected a file system that can";
    const int finest = table.domain.finest_level();
    // A level has half the diamonds of the next finer one, and about as much work for each.
    const auto say = [&](int level) {
        if (progress) progress(0.9 * (1.0 - 1.0 / double(uint64_t{1} << (finest - level))));
    };
    fill_table(grid, table, threads, say);
    if (progress) progress(0.9);
    header.pages = summarise(table, threads);
    const std::string bytes = pack_header(header);
    if (!file.write_at(0, bytes.data(), bytes.size())) return "cannot be written, expected a writable place";
    table.slots = {};
    return file.flush() ? "" : "cannot be written to disk, expected a working file system";
}

}  // namespace

lod::Result<StoreReport> build_store(const data::HeightGrid& grid, const std::string& path, unsigned threads,
                                     const std::function<void(double)>& progress) {
    const std::string temporary = path + ".part" + std::to_string(getpid());
    const FileHandle file = FileHandle::for_writing(temporary);
    const std::string where = "terrain store '" + path + "' ";
    if (!file.is_open()) return lod::Error{where + "cannot be written, expected a writable place"};
    std::string fault = write_store(grid, file, threads, progress);
    if (fault.empty() && std::rename(temporary.c_str(), path.c_str()) != 0)
        fault = "cannot be put in its place, expected a path that can be written";
    if (!fault.empty()) {
        std::remove(temporary.c_str());
        return lod::Error{where + fault};
    }
    const PageLayout layout(make_domain(grid.width, grid.height));
    return StoreReport{file.size_bytes(), layout.page_count()};
}

}  // namespace terrain
