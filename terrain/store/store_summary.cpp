#include "terrain/store/store_summary.h"

#include <algorithm>
#include <limits>

#include "lod/base/parallel.h"

namespace terrain {
namespace {

struct HeightRange {
    float min_m = std::numeric_limits<float>::infinity();
    float max_m = -std::numeric_limits<float>::infinity();

    void add(float least_m, float most_m) {
        min_m = std::min(min_m, least_m);
        max_m = std::max(max_m, most_m);
    }
};

struct Summary {
    const DiamondTable& table;
    const PageDirectory& directory;
    float level_m;
    std::vector<PageSummary> entries;

    /// Heights in and below a page; those below are known.
    HeightRange heights_of(size_t entry) const {
        const PageId id = directory.id(entry);
        HeightRange range;
        for_each_diamond(table.domain, id, [&](GridPoint centre, int level) {
            const float height_m = table.at(centre, level).height_m;
            range.add(height_m, height_m);
        });
        for_each_child(table.layout, id, [&](const PageId& child) {
            const uint32_t below = directory.entry_of(child);
            if (below == PageDirectory::kNone) {
                range.add(level_m, level_m);
            } else {
                range.add(entries[below].min_m, entries[below].max_m);
            }
        });
        if (range.min_m > range.max_m) range = {table.min_m, table.max_m};  // beyond the raster
        return range;
    }
};

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

}  // namespace

/// Finest group first: a page's summary needs those of its children.
std::vector<PageSummary> summarise(const DiamondTable& table, const PageDirectory& directory, float level_m,
                                   unsigned threads) {
    Summary summary{table, directory, level_m, std::vector<PageSummary>(directory.count())};
    const auto checksum = [&](size_t entry) {
        return checksum_of(&table.slots[entry * kPageEntries], kPageBytes);
    };
    for (size_t entry = 0; entry < directory.level_count(); ++entry)
        summary.entries[entry] = {checksum(entry), 0, 0, level_m, level_m};
    for (int group = table.layout.group_count() - 1; group >= 0; --group) {
        const size_t first = directory.first_of_group(group), next = directory.first_of_group(group + 1);
        lod::parallel_for(next - first, threads, [&](size_t begin, size_t end) {
            for (size_t entry = first + begin; entry < first + end; ++entry) {
                const HeightRange range = summary.heights_of(entry);
                summary.entries[entry] = {checksum(entry), error_without(table, directory.id(entry)), 0,
                                          range.min_m, range.max_m};
            }
        });
    }
    return std::move(summary.entries);
}

}  // namespace terrain
