#include "terrain/diamond_table.h"

#include <algorithm>
#include <cmath>

#include "lod/base/check.h"
#include "lod/base/parallel.h"
#include "terrain/triangle_error.h"

namespace terrain {
namespace {

/// What every diamond of one level shares.
struct LevelPass {
    const data::HeightGrid& grid;
    DiamondTable& table;
    int level;
    int reach;
    double cells;  ///< longest edge of the level's triangles, in cells
};

bool is_inside_raster(const Domain& domain, const TriangleCorners& t) {
    return domain.in_raster(t.apex) && domain.in_raster(t.left) && domain.in_raster(t.right);
}

struct HalfResult {
    float error_m = 0.0f;
    bool is_empty = false;  ///< covers no valid sample
};

HalfResult half_error(const LevelPass& pass, const TriangleCorners& t) {
    const Domain& domain = pass.table.domain;
    const TriangleError raw = is_inside_raster(domain, t) ? regular_triangle_error(pass.grid, t)
                                                          : clamped_triangle_error(pass.grid, domain, t);
    HalfResult half{raw.residual_m, false};
    const auto chord = pass.grid.frame.chord_error_per_cell2();
    const glm::dvec2 cell = pass.grid.frame.cell_m();
    if (chord.up_m > 0.0) {
        const double slope =
            std::abs(double(raw.gradient_x)) / cell.x + std::abs(double(raw.gradient_y)) / cell.y;
        half.error_m += static_cast<float>(pass.cells * pass.cells * (chord.up_m + slope * chord.side_m));
    }
    if (pass.grid.has_voids()) {
        const VoidCover cover = void_cover(pass.grid, domain, t);
        half.is_empty = !cover.any_valid;
        if (cover.any_valid &&
            cover.any_void) {  // the rim of a hole is off by as much as the triangle is long
            half.error_m += static_cast<float>(pass.cells * std::max(cell.x, cell.y));
        }
    }
    return half;
}

/// Height and rise of a centre beyond or inside the raster.
DiamondSource outline(const LevelPass& pass, GridPoint centre, int apex_dir) {
    const Domain& domain = pass.table.domain;
    const GridPoint at = domain.clamped(centre);
    DiamondSource source;
    source.height_m = pass.grid.at(at.x, at.y);
    float rise = 0.0f;
    for (int corner = 0; corner < 4; ++corner) {
        const GridPoint p = step_from(centre, apex_dir + 2 * corner, pass.reach);
        if (!domain.contains(p)) continue;
        const GridPoint q = domain.clamped(p);
        rise = std::max(rise, std::abs(pass.grid.at(q.x, q.y) - source.height_m));
    }
    source.set_rise(rise);
    if (pass.grid.void_at(at.x, at.y)) source.rise_and_voids |= DiamondSource::kVoidCentre;
    return source;
}

void fill_diamond(const LevelPass& pass, GridPoint centre) {
    DiamondTable& table = pass.table;
    const Domain& domain = table.domain;
    const int apex_dir = apex_direction(domain, centre, pass.level);
    DiamondSource source = outline(pass, centre, apex_dir);
    float error_m = 0.0f;
    for (int half = 0; half < 2; ++half) {
        const int dir = (apex_dir + 4 * half) & 7;
        const TriangleCorners t{step_from(centre, dir, pass.reach), step_from(centre, dir + 2, pass.reach),
                                step_from(centre, dir - 2, pass.reach)};
        if (!domain.contains(t.apex)) continue;
        const HalfResult one = half_error(pass, t);
        error_m = std::max(error_m, one.error_m);
        if (one.is_empty) source.set_half_empty(dir);
    }
    source.error_code = encode_length(error_m);
    if (pass.level < domain.finest_level()) {
        for (int side = 0; side < 4; ++side) {
            const GridPoint child = step_from(centre, apex_dir + 2 * side + 1, domain.child_step(pass.level));
            if (!domain.contains(child)) continue;
            source.error_code = std::max(source.error_code, table.at(child, pass.level + 1).error_code);
        }
    }
    const PagePlace place = table.layout.place(centre, pass.level);
    table.slots[table.slot_of_page[place.page] * kPageEntries + place.entry] = source;
}

void fill_row(const LevelPass& pass, int y) {
    const Domain& domain = pass.table.domain;
    const bool turned = (pass.level & 1) != 0;
    const int first = turned && ((y / pass.reach) & 1) != 0 ? 0 : pass.reach;
    for (int x = first; x - pass.reach < domain.width - 1 && x <= domain.side(); x += 2 * pass.reach) {
        fill_diamond(pass, {x, y});
    }
}

void fill_level(const LevelPass& pass, unsigned threads) {
    const Domain& domain = pass.table.domain;
    const bool turned = (pass.level & 1) != 0;
    const int first = turned ? 0 : pass.reach, stride = turned ? pass.reach : 2 * pass.reach;
    std::vector<int> rows;
    for (int y = first; y - pass.reach < domain.height - 1 && y <= domain.side(); y += stride)
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
    for (int corner = 0; corner < 4; ++corner) {
        const GridPoint p = domain.clamped({(corner & 1) * domain.side(), (corner >> 1) * domain.side()});
        table.corners[corner].height_m = grid.at(p.x, p.y);
        if (grid.void_at(p.x, p.y)) table.corners[corner].rise_and_voids = DiamondSource::kVoidCentre;
    }
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
        const int reach = table.domain.reach(level);
        const double cells = reach * ((level & 1) == 0 ? 2.0 * std::sqrt(2.0) : 2.0);
        fill_level({grid, table, level, reach, cells}, threads);
    }
}

}  // namespace terrain
