#include "terrain/store/sparse_builder.h"

#include <algorithm>

#include "lod/base/check.h"
#include "lod/base/parallel.h"
#include "terrain/store/page_directory.h"

namespace terrain {
namespace {

/// What a page's diamonds cover, saturated errors included, reaches over its ground by less than this many reaches of its
/// square level: one for its own, as much again for all below it, and one more.
constexpr int kRimReaches = 4;

/// Sample coordinates from `first` to `last` that a page speaks of, along one axis.
struct Extent {
    int first = 0, last = 0;
};
Extent extent_of(const Domain& domain, int group, int block, int sample_count) {
    const int reach = domain.reach(2 * group), width = 2 * reach * kPageSide;
    const auto clamp = [&](int at) { return std::clamp(at, 0, sample_count - 1); };
    return {clamp(block * width - kRimReaches * reach), clamp((block + 1) * width + kRimReaches * reach)};
}

/// Whether some diamond of a page reaches into the raster.
bool is_needed(const Domain& domain, const PageId& id) {
    const int reach = domain.reach(2 * id.group), width = 2 * reach * kPageSide;
    return id.block_x * width - reach < domain.width - 1 && id.block_y * width - reach < domain.height - 1;
}

bool is_near_relief(const SparseRelief& relief, const PageId& id) {
    if (!is_needed(relief.domain, id)) return false;
    const Extent x = extent_of(relief.domain, id.group, id.block_x, relief.domain.width);
    const Extent y = extent_of(relief.domain, id.group, id.block_y, relief.domain.height);
    return std::any_of(relief.patches.begin(), relief.patches.end(), [&](const ReliefPatch& patch) {
        return patch.first.x <= x.last && patch.first.x + patch.width > x.first && patch.first.y <= y.last &&
               patch.first.y + patch.height > y.first;
    });
}

/// The root's page, and all pages that a patch is near, by number.
std::vector<uint64_t> pages_near_relief(const SparseRelief& relief, const PageLayout& layout) {
    std::vector<uint64_t> numbers{0};
    for (size_t i = 0; i < numbers.size(); ++i) {
        for_each_child(layout, layout.id(numbers[i]), [&](const PageId& child) {
            if (is_near_relief(relief, child)) numbers.push_back(layout.number(child));
        });
    }
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

/// Calls visit(centre, entry) for the diamonds of one level that a page holds and that reach into the raster.
template <typename Visit>
void for_each_held(const Domain& domain, const PageLayout& layout, const PageId& id, int level,
                   const Visit& visit) {
    const int reach = domain.reach(level), width = 2 * reach * kPageSide;
    const bool is_turned = (level & 1) != 0;
    const size_t number = layout.number(id);
    for (int y = id.block_y * width; y <= std::min((id.block_y + 1) * width, domain.side()); y += reach) {
        for (int x = id.block_x * width; x <= std::min((id.block_x + 1) * width, domain.side()); x += reach) {
            const bool is_odd_x = (x / reach & 1) != 0, is_odd_y = (y / reach & 1) != 0;
            if (is_turned ? is_odd_x == is_odd_y : !(is_odd_x && is_odd_y)) continue;
            if (x - reach >= domain.width - 1 || y - reach >= domain.height - 1) continue;
            const PagePlace place = layout.place({x, y}, level);
            if (place.page == number) visit(GridPoint{x, y}, place.entry);
        }
    }
}

void fill_held(const SparseRelief& relief, DiamondTable& table, const PageId& id, int level) {
    const Domain& domain = table.domain;
    DiamondSource* facts = &table.slots[size_t(table.slot_of_page[table.layout.number(id)]) * kPageEntries];
    for_each_held(domain, table.layout, id, level, [&](GridPoint centre, size_t entry) {
        DiamondSource source = sparse_facts(relief, centre, level);
        const int apex_dir = apex_direction(domain, centre, level);
        for (int side = 0; side < 4 && level < domain.finest_level(); ++side) {
            const GridPoint child = step_from(centre, apex_dir + 2 * side + 1, domain.child_step(level));
            if (!domain.contains(child)) continue;
            source.error_code = std::max(source.error_code, table.at(child, level + 1).error_code);
        }
        facts[entry] = source;
    });
}

DiamondTable frame_of(const SparseRelief& relief) {
    DiamondTable table{.domain = relief.domain,
                       .layout = PageLayout(relief.domain),
                       .frame = relief.frame,
                       .min_m = relief.level_m,
                       .max_m = relief.level_m,
                       .has_voids = false,
                       .corners = {},
                       .slot_of_page = {},
                       .slots = {}};
    for (const ReliefPatch& patch : relief.patches) {
        const auto [least, most] = std::minmax_element(patch.height_m.begin(), patch.height_m.end());
        table.min_m = std::min(table.min_m, *least);
        table.max_m = std::max(table.max_m, *most);
    }
    const int side = relief.domain.side();
    for (int corner = 0; corner < 4; ++corner)
        table.corners[corner].height_m = relief.height_at({(corner & 1) * side, (corner >> 1) * side});
    return table;
}

void check_relief(const SparseRelief& relief) {
    const Domain& domain = relief.domain;
    CHECK(domain.width >= 2 && domain.height >= 2 && domain.log2_side <= kMostLog2Side);
    for (const ReliefPatch& patch : relief.patches) {
        CHECK(patch.width >= 1 && patch.height >= 1 &&
              patch.height_m.size() == static_cast<size_t>(patch.width) * static_cast<size_t>(patch.height));
        CHECK(patch.first.x >= 0 && patch.first.x + patch.width <= domain.width && patch.first.y >= 0 &&
              patch.first.y + patch.height <= domain.height);
    }
}

}  // namespace

lod::Result<StoreReport> build_sparse_store(const SparseRelief& relief, const std::string& path,
                                            unsigned threads, const std::function<void(double)>& progress) {
    check_relief(relief);
    StoreDraft draft{frame_of(relief), {}, relief.level_m};
    draft.numbers = pages_near_relief(relief, draft.table.layout);
    const PageDirectory directory(draft.table.layout, draft.numbers);
    return write_store(std::move(draft), path, threads, [&](DiamondTable& table) {
        for (size_t group = 0; group < directory.level_count(); ++group)
            fill_level_page(relief, static_cast<int>(group),
                            {&table.slots[group * kPageEntries], kPageEntries});
        for (int level = table.domain.finest_level(); level >= 0; --level) {
            const size_t first = directory.first_of_group(level / 2);
            lod::parallel_for(directory.first_of_group(level / 2 + 1) - first, threads,
                              [&](size_t begin, size_t end) {
                                  for (size_t entry = first + begin; entry < first + end; ++entry)
                                      fill_held(relief, table, directory.id(entry), level);
                              });
            if (progress) progress(0.9 * (1.0 - double(level) / (table.domain.finest_level() + 1)));
        }
    });
}

}  // namespace terrain
