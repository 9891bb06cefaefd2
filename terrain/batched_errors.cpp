#include "terrain/batched_errors.h"

#include <algorithm>
#include <vector>

#include "lod/base/check.h"
#include "lod/base/parallel.h"
#include "terrain/triangle_error.h"

namespace terrain {
namespace {

/// Centres of one level's diamonds that touch the raster, row by row.
template <typename Visit>
void for_each_diamond(const Domain& domain, int level, unsigned threads, const Visit& visit) {
    const int reach = domain.reach(level);
    const bool turned = (level & 1) != 0;
    const int first_y = turned ? 0 : reach, stride_y = turned ? reach : 2 * reach;
    const int last_y = std::min(domain.side(), domain.height - 2 + reach);
    if (last_y < first_y) return;
    const auto row_count = static_cast<size_t>((last_y - first_y) / stride_y + 1);
    lod::parallel_for(row_count, threads, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row) {
            const int y = first_y + static_cast<int>(row) * stride_y;
            const int first_x = turned && ((y / reach) & 1) != 0 ? 0 : reach;
            const int last_x = std::min(domain.side(), domain.width - 2 + reach);
            for (int x = first_x; x <= last_x; x += 2 * reach)
                visit(GridPoint{x, y});
        }
    });
}

DiamondSource& fact_of(DiamondTable& table, GridPoint centre, int level) {
    const PagePlace place = table.layout.place(centre, level);
    return table.slots[size_t(table.slot_of_page[place.page]) * kPageEntries + place.entry];
}

/// The largest error of what a triangle of this level is drawn as, so many levels deeper.
uint16_t drawn_error(const DiamondTable& table, int level, int deeper, const TriangleCorners& t) {
    if (level > table.domain.finest_level()) return 0;  // half a cell
    const GridPoint middle{(t.left.x + t.right.x) / 2, (t.left.y + t.right.y) / 2};
    if (deeper == 0) return table.at(middle, level).error_code;
    return std::max(drawn_error(table, level + 1, deeper - 1, {middle, t.apex, t.left}),
                    drawn_error(table, level + 1, deeper - 1, {middle, t.right, t.apex}));
}

void shift_error(DiamondTable& table, int level, int deeper, GridPoint centre) {
    const Domain& domain = table.domain;
    DiamondSource& fact = fact_of(table, centre, level);
    fact.set_rise(fact.rise_m() + fact.error_m());
    fact.error_code = 0;
    if (level + deeper > domain.finest_level()) return;
    const int apex_dir = apex_direction(domain, centre, level), reach = domain.reach(level);
    for (int dir = apex_dir; dir <= apex_dir + 4; dir += 4) {
        const TriangleCorners t{step_from(centre, dir, reach), step_from(centre, dir + 2, reach),
                                step_from(centre, dir - 2, reach)};
        if (!domain.contains(t.apex)) continue;
        fact.error_code = std::max(fact.error_code, drawn_error(table, level, deeper, t));
    }
}

void saturate(DiamondTable& table, int level, GridPoint centre) {
    const Domain& domain = table.domain;
    DiamondSource& fact = fact_of(table, centre, level);
    const int apex_dir = apex_direction(domain, centre, level);
    for (int side = 0; side < 4; ++side) {
        const GridPoint child = step_from(centre, apex_dir + 2 * side + 1, domain.child_step(level));
        if (domain.contains(child))
            fact.error_code = std::max(fact.error_code, table.at(child, level + 1).error_code);
    }
}

}  // namespace

void batch_errors(DiamondTable& table, int batch, unsigned threads) {
    CHECK(batch >= 0 && batch <= kMostBatch);
    if (batch == 0) return;
    const Domain domain = table.domain;
    const int finest = domain.finest_level();
    // Coarse before fine: what lies deeper is still what it was.
    for (int level = 0; level <= finest; ++level) {
        for_each_diamond(domain, level, threads,
                         [&](GridPoint centre) { shift_error(table, level, 2 * batch, centre); });
    }
    for (int level = finest - 2 * batch - 1; level >= 0; --level) {
        for_each_diamond(domain, level, threads, [&](GridPoint centre) { saturate(table, level, centre); });
    }
}

}  // namespace terrain
