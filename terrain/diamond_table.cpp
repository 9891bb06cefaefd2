#include "terrain/diamond_table.h"

#include <algorithm>

#include "lod/base/check.h"
#include "lod/base/parallel.h"
#include "terrain/diamond_facts.h"
#include "terrain/fact_row.h"

namespace terrain {
namespace {

/// What every diamond of one level shares.
struct LevelPass {
    FactsPass facts;
    DiamondTable& table;
};

void fill_row(const LevelPass& pass, int y) {
    const Domain& domain = pass.table.domain;
    const int reach = pass.facts.reach;
    const bool turned = (pass.facts.level & 1) != 0;
    const int first = turned && ((y / reach) & 1) != 0 ? 0 : reach;
    FactRow row(pass.table, pass.facts.level, y);
    ChildCodes children(pass.table, pass.facts.level, y);
    for (int x = first; x - reach < domain.width - 1 && x <= domain.side(); x += 2 * reach) {
        DiamondSource source = own_facts(pass.facts, {x, y});
        source.error_code = std::max(source.error_code, children.largest(x));
        row.at(x) = source;
    }
}

void fill_level(const LevelPass& pass, unsigned threads) {
    const Domain& domain = pass.table.domain;
    const int reach = pass.facts.reach;
    const bool turned = (pass.facts.level & 1) != 0;
    const int first = turned ? 0 : reach, stride = turned ? reach : 2 * reach;
    std::vector<int> rows;
    for (int y = first; y - reach < domain.height - 1 && y <= domain.side(); y += stride)
        rows.push_back(y);
    lod::parallel_for(rows.size(), threads, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            fill_row(pass, rows[i]);
    });
}

}  // namespace

DiamondTable make_table_frame(const data::HeightGrid& grid) {
    CHECK(grid.width >= 2 && grid.height >= 2 && grid.width <= 32769 && grid.height <= 32769);
    const Domain domain = make_domain(grid.width, grid.height);
    DiamondTable table{.domain = domain,
                       .layout = PageLayout(domain),
                       .frame = grid.frame,
                       .min_m = grid.min_m,
                       .max_m = grid.max_m,
                       .has_voids = grid.has_voids(),
                       .corners = {},
                       .slot_of_page = {},
                       .slots = {}};
    set_corners(grid, table);
    table.slot_of_page = PageMap(table.layout.page_count(), DiamondTable::kAbsent);
    return table;
}

DiamondTable make_diamond_table(const data::HeightGrid& grid, unsigned threads) {
    DiamondTable table = make_table_frame(grid);
    table.slots = FactMemory(table.layout.page_count() * kPageEntries);
    fill_table(grid, table, threads, nullptr);
    return table;
}

void fill_table(const data::HeightGrid& grid, DiamondTable& table, unsigned threads,
                const std::function<void(int level)>& progress) {
    CHECK(table.slots.size() == table.layout.page_count() * kPageEntries);
    for (size_t page = 0; page < table.slot_of_page.size(); ++page)
        table.slot_of_page.set(page, static_cast<uint32_t>(page));
    for (int level = table.domain.finest_level(); level >= 0; --level) {
        if (progress) progress(level);
        fill_level({make_facts_pass(grid, table.domain, level), table}, threads);
    }
}

}  // namespace terrain
