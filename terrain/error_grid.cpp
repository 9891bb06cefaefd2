#include "terrain/error_grid.h"

#include <algorithm>
#include <cmath>

#include "lod/base/check.h"
#include "lod/base/parallel.h"
#include "terrain/triangle_error.h"

namespace terrain {
namespace {

/// One level's work: all diamonds of a row of centres.
struct LevelPass {
    const data::HeightGrid& grid;
    ErrorGrid& errors;
    int level;
};

/// Longest edge of the triangles of a level, in cells.
double hypotenuse_cells(const Domain& domain, int level) {
    return domain.reach(level) * ((level & 1) == 0 ? 2.0 * std::sqrt(2.0) : 2.0);
}

bool is_inside_raster(const Domain& domain, const TriangleCorners& t) {
    return domain.in_raster(t.apex) && domain.in_raster(t.left) && domain.in_raster(t.right);
}

struct HalfResult {
    float error_m = 0.0f;
    bool is_empty = false;  ///< covers no valid sample
};

HalfResult half_error(const LevelPass& pass, const TriangleCorners& t, bool inside) {
    const Domain& domain = pass.errors.domain;
    const TriangleError raw =
        inside ? regular_triangle_error(pass.grid, t) : clamped_triangle_error(pass.grid, domain, t);
    HalfResult half{raw.residual_m, false};
    const double cells = hypotenuse_cells(domain, pass.level);
    const auto chord = pass.grid.frame.chord_error_per_cell2();
    half.error_m += static_cast<float>(cells * cells * (chord.up_m + double(raw.slope) * chord.side_m));
    if (pass.grid.has_voids()) {
        const VoidCover cover = void_cover(pass.grid, domain, t);
        half.is_empty = !cover.any_valid;
        if (cover.any_valid &&
            cover.any_void) {  // the rim of a hole is off by as much as the triangle is long
            const glm::dvec2 cell = pass.grid.frame.cell_m();
            half.error_m += static_cast<float>(cells * std::max(cell.x, cell.y));
        }
    }
    return half;
}

struct DiamondResult {
    float error_m = 0.0f;
    uint8_t empty_halves = 0;
};

DiamondResult diamond_error(const LevelPass& pass, GridPoint centre) {
    const Domain& domain = pass.errors.domain;
    const int reach = domain.reach(pass.level);
    const int apex_dir = apex_direction(domain, centre, pass.level);
    DiamondResult result;
    for (int half = 0; half < 2; ++half) {
        const int dir = (apex_dir + 4 * half) & 7;
        const TriangleCorners t{step_from(centre, dir, reach), step_from(centre, dir + 2, reach),
                                step_from(centre, dir - 2, reach)};
        if (!domain.contains(t.apex)) continue;
        const HalfResult one = half_error(pass, t, is_inside_raster(domain, t));
        result.error_m = std::max(result.error_m, one.error_m);
        if (one.is_empty)
            result.empty_halves = static_cast<uint8_t>(result.empty_halves | (1 << half_bit(dir)));
    }
    if (pass.level < domain.finest_level()) {
        for (int side = 0; side < 4; ++side) {
            const GridPoint child = step_from(centre, apex_dir + 2 * side + 1, domain.child_step(pass.level));
            if (domain.contains(child)) result.error_m = std::max(result.error_m, pass.errors.error_m(child));
        }
    }
    return result;
}

/// Diamonds beyond the raster found by one thread.
using OutsideList = std::vector<std::pair<uint64_t, uint16_t>>;

void diamond_row(const LevelPass& pass, int y, OutsideList& outside) {
    ErrorGrid& errors = pass.errors;
    const Domain& domain = errors.domain;
    const int reach = domain.reach(pass.level);
    const bool turned = (pass.level & 1) != 0;
    const int first = turned ? ((y / reach) & 1 ? 0 : reach) : reach;
    for (int x = first; x - reach < domain.width - 1 && x <= domain.side(); x += 2 * reach) {
        const DiamondResult result = diamond_error(pass, {x, y});
        if (domain.in_raster({x, y})) {
            const size_t i = pass.grid.index(x, y);
            errors.code[i] = encode_error(result.error_m);
            if (!errors.empty_halves.empty()) errors.empty_halves[i] = result.empty_halves;
        } else if (result.error_m > 0.0f) {
            outside.emplace_back(ErrorGrid::outside_key({x, y}), encode_error(result.error_m));
        }
    }
}

void level_pass(const LevelPass& pass, unsigned threads) {
    const Domain& domain = pass.errors.domain;
    const int reach = domain.reach(pass.level);
    const bool turned = (pass.level & 1) != 0;
    const int first = turned ? 0 : reach, stride = turned ? reach : 2 * reach;
    std::vector<int> rows;
    for (int y = first; y - reach < domain.height - 1 && y <= domain.side(); y += stride)
        rows.push_back(y);

    std::vector<OutsideList> outside(rows.size());
    lod::parallel_for(rows.size(), threads, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            diamond_row(pass, rows[i], outside[i]);
    });
    for (const OutsideList& list : outside)
        pass.errors.outside.insert(list.begin(), list.end());
}

}  // namespace

uint16_t encode_error(float error_m) {
    if (!(error_m > 0.0f)) return 0;
    constexpr uint32_t kBase = (127u - 13u) << 11;
    const uint32_t bits = (std::bit_cast<uint32_t>(error_m) + 0xfffu) >> 12;
    if (bits <= kBase) return 1;
    return static_cast<uint16_t>(std::min(bits - kBase + 1u, 65535u));
}

ErrorGrid compute_errors(const data::HeightGrid& grid, unsigned threads) {
    CHECK(grid.width >= 2 && grid.height >= 2 && grid.width <= 32769 && grid.height <= 32769);
    ErrorGrid errors;
    errors.domain = make_domain(grid.width, grid.height);
    errors.code.resize(grid.height_m.size());
    if (grid.has_voids()) errors.empty_halves.resize(grid.height_m.size());
    for (int level = errors.domain.finest_level(); level >= 0; --level) {
        level_pass({grid, errors, level}, threads);
    }
    return errors;
}

}  // namespace terrain
