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
    source.rise_code = encode_length(rise);
    return source;
}

void fill_diamond(const LevelPass& pass, GridPoint centre) {
    DiamondTable& table = pass.table;
    const Domain& domain = table.domain;
    const int apex_dir = apex_direction(domain, centre, pass.level);
    const size_t index = table.index(centre, pass.level);
    DiamondSource source = outline(pass, centre, apex_dir);
    float error_m = 0.0f;
    for (int half = 0; half < 2; ++half) {
        const int dir = (apex_dir + 4 * half) & 7;
        const TriangleCorners t{step_from(centre, dir, pass.reach), step_from(centre, dir + 2, pass.reach),
                                step_from(centre, dir - 2, pass.reach)};
        if (!domain.contains(t.apex)) continue;
        const HalfResult one = half_error(pass, t);
        error_m = std::max(error_m, one.error_m);
        if (one.is_empty)
            table.empty_halves[index] =
                static_cast<uint8_t>(table.empty_halves[index] | (1 << half_bit(dir)));
    }
    source.error_code = encode_length(error_m);
    if (pass.level < domain.finest_level()) {
        for (int side = 0; side < 4; ++side) {
            const GridPoint child = step_from(centre, apex_dir + 2 * side + 1, domain.child_step(pass.level));
            if (!domain.contains(child)) continue;
            source.error_code = std::max(source.error_code, table.at(child, pass.level + 1).error_code);
        }
    }
    table.sources[index] = source;
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

/// Room for every diamond of the domain. Those that do not reach into the raster stay zero.
void lay_out(DiamondTable& table) {
    const Domain& domain = table.domain;
    size_t size = 0;
    for (int level = 0; level <= domain.finest_level(); ++level) {
        const int reach = domain.reach(level);
        const bool turned = (level & 1) != 0;
        const int shift = std::countr_zero(static_cast<unsigned>(reach));
        DiamondTable::Level l;
        l.first = size;
        l.column_shift = shift + 1;
        l.row_shift = turned ? shift : shift + 1;
        l.columns = static_cast<size_t>(domain.side() >> l.column_shift) + 1;
        size += l.columns * (static_cast<size_t>(domain.side() >> l.row_shift) + 1);
        table.levels.push_back(l);
    }
    table.sources.resize(size);
}

}  // namespace

uint16_t encode_length(float length_m) {
    if (!(length_m > 0.0f)) return 0;
    constexpr uint32_t kBase = (127u - 13u) << 11;
    const uint32_t bits = (std::bit_cast<uint32_t>(length_m) + 0xfffu) >> 12;
    if (bits <= kBase) return 1;
    return static_cast<uint16_t>(std::min(bits - kBase + 1u, 65535u));
}

DiamondTable make_diamond_table(const data::HeightGrid& grid, unsigned threads) {
    CHECK(grid.width >= 2 && grid.height >= 2 && grid.width <= 32769 && grid.height <= 32769);
    DiamondTable table;
    table.domain = make_domain(grid.width, grid.height);
    lay_out(table);
    if (grid.has_voids()) table.empty_halves.resize(table.sources.size());
    for (int level = table.domain.finest_level(); level >= 0; --level) {
        const int reach = table.domain.reach(level);
        const double cells = reach * ((level & 1) == 0 ? 2.0 * std::sqrt(2.0) : 2.0);
        fill_level({grid, table, level, reach, cells}, threads);
    }
    return table;
}

}  // namespace terrain
