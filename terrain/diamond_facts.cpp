#include "terrain/diamond_facts.h"

#include <algorithm>
#include <cmath>

#include "terrain/small_diamond.h"

namespace terrain {
namespace {

/// Below this reach a triangle has too few samples for a search to pay.
constexpr int kSearchReach = 32;

bool is_inside_raster(const Domain& domain, const TriangleCorners& t) {
    return domain.in_raster(t.apex) && domain.in_raster(t.left) && domain.in_raster(t.right);
}

struct HalfResult {
    float error_m = 0.0f;
    bool is_empty = false;  ///< covers no valid sample
};

/// What the samples of one triangle say.
struct HalfSamples {
    TriangleError error;
    VoidCover cover;
};

HalfSamples look_at(const FactsPass& pass, const TriangleCorners& t, uint64_t* samples) {
    HalfSamples half;
    const bool has_voids = pass.grid.has_voids();
    if (pass.extremes != nullptr && pass.reach >= kSearchReach) {
        const SearchedGround ground{pass.grid, *pass.extremes};
        uint64_t looked_at = 0;
        half.error = find_triangle_error(ground, pass.domain, t, looked_at);
        if (has_voids) half.cover = find_void_cover(ground, pass.domain, t);
        if (samples != nullptr) *samples += looked_at;
        return half;
    }
    half.error = is_inside_raster(pass.domain, t) ? regular_triangle_error(pass.grid, t)
                                                  : clamped_triangle_error(pass.grid, pass.domain, t);
    if (has_voids) half.cover = void_cover(pass.grid, pass.domain, t);
    return half;
}

HalfResult half_error(const FactsPass& pass, const TriangleCorners& t, uint64_t* samples) {
    const auto [raw, cover] = look_at(pass, t, samples);
    HalfResult half{raw.residual_m + chord_error_m(pass, raw), false};
    if (pass.grid.has_voids()) {
        half.is_empty = !cover.any_valid;
        if (cover.any_valid &&
            cover.any_void) {  // the rim of a hole is off by as much as the triangle is long
            const glm::dvec2 cell = pass.grid.frame.cell_m();
            half.error_m += static_cast<float>(pass.cells * std::max(cell.x, cell.y));
        }
    }
    return half;
}

/// Height and rise of a centre beyond or inside the raster.
DiamondSource outline(const FactsPass& pass, GridPoint centre, int apex_dir) {
    const Domain& domain = pass.domain;
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

}  // namespace

FactsPass make_facts_pass(const data::HeightGrid& grid, const Domain& domain, int level) {
    const int reach = domain.reach(level);
    const double cells = reach * ((level & 1) == 0 ? 2.0 * std::sqrt(2.0) : 2.0);
    return {grid, domain, level, reach, cells, nullptr};
}

DiamondSource own_facts(const FactsPass& pass, GridPoint centre, uint64_t* samples) {
    if (is_small(pass, centre)) return small_facts(pass, centre);
    const int apex_dir = apex_direction(pass.domain, centre, pass.level);
    DiamondSource source = outline(pass, centre, apex_dir);
    float error_m = 0.0f;
    for (int half = 0; half < 2; ++half) {
        const int dir = (apex_dir + 4 * half) & 7;
        const TriangleCorners t{step_from(centre, dir, pass.reach), step_from(centre, dir + 2, pass.reach),
                                step_from(centre, dir - 2, pass.reach)};
        if (!pass.domain.contains(t.apex)) continue;
        const HalfResult one = half_error(pass, t, samples);
        error_m = std::max(error_m, one.error_m);
        if (one.is_empty) source.set_half_empty(dir);
    }
    source.error_code = encode_length(error_m);
    return source;
}

uint16_t error_code_below(const DiamondTable& table, GridPoint centre, int level) {
    const Domain& domain = table.domain;
    if (level >= domain.finest_level()) return 0;
    const int apex_dir = apex_direction(domain, centre, level);
    uint16_t code = 0;
    for (int side = 0; side < 4; ++side) {
        const GridPoint child = step_from(centre, apex_dir + 2 * side + 1, domain.child_step(level));
        if (domain.contains(child)) code = std::max(code, table.at(child, level + 1).error_code);
    }
    return code;
}

void set_corners(const data::HeightGrid& grid, DiamondTable& table) {
    const Domain& domain = table.domain;
    for (int corner = 0; corner < 4; ++corner) {
        const GridPoint p = domain.clamped({(corner & 1) * domain.side(), (corner >> 1) * domain.side()});
        table.corners[corner].height_m = grid.at(p.x, p.y);
        if (grid.void_at(p.x, p.y)) table.corners[corner].rise_and_voids = DiamondSource::kVoidCentre;
    }
}

}  // namespace terrain
