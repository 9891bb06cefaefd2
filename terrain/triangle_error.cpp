#include "terrain/triangle_error.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "terrain/block_search.h"
#include "terrain/regular_triangle.h"
#include "terrain/triangle_rows.h"

namespace terrain {
namespace {

using Lanes = float __attribute__((vector_size(32)));
constexpr int kLaneCount = 8;

/// max_residual; rows too short for a vector stay here, without a call.
inline float row_residual(const float* samples, int count, float first, float gradient) {
    if (count >= kLaneCount) return max_residual(samples, count, first, gradient);
    float worst = 0.0f;
    for (int i = 0; i < count; ++i) {
        worst = std::max(worst, std::abs(samples[i] - (first + gradient * static_cast<float>(i))));
    }
    return worst;
}

/// Looks at every sample.
struct Scan {
    const data::HeightGrid& grid;

    template <typename Rows>
    float operator()(const TriangleCorners&, const Rows& rows) const {
        float worst = 0.0f;
        for (int y = rows.first_y; y <= rows.last_y; ++y) {
            SampleRow row;
            if (!rows.at(y, row)) continue;
            worst = std::max(worst, row_residual(&grid.height_m[grid.index(row.x, y)], row.count, row.first_m,
                                                 rows.gradient));
        }
        return worst;
    }
};

/// Looks where the worst may be.
struct Search {
    const data::HeightGrid& grid;
    const data::HeightExtremes& extremes;
    uint64_t& samples;

    /// @param t  clamped corners
    template <typename Rows>
    float operator()(const TriangleCorners& t, const Rows& rows) const {
        const TriangleSides sides(t.apex, t.left, t.right);
        WorstSearch search(grid, extremes, sides, rows, plane_of(t));
        const float worst = search.run();
        samples += search.samples();
        return worst;
    }

  private:
    SearchPlane plane_of(const TriangleCorners& t) const {
        const double a = double{grid.at(t.apex.x, t.apex.y)};
        const double left = double{grid.at(t.left.x, t.left.y)} - a,
                     right = double{grid.at(t.right.x, t.right.y)} - a;
        const double lx = t.left.x - t.apex.x, ly = t.left.y - t.apex.y, rx = t.right.x - t.apex.x,
                     ry = t.right.y - t.apex.y;
        const double area = lx * ry - rx * ly;
        return {t.apex, a, (left * ry - right * ly) / area, (right * lx - left * rx) / area};
    }
};

struct BlockPlace {
    size_t level = 0;
    glm::ivec2 at{0};
};

/// Samples of a block that lie in a triangle, until there are some of each kind.
void gather_voids(const SearchedGround& ground, const TriangleSides& sides, const RowSpans& rows,
                  const BlockPlace& place, VoidCover& cover) {
    if (cover.any_valid && cover.any_void) return;
    const data::HeightExtremes::Level& level = ground.extremes.levels[place.level];
    if (place.at.x >= level.columns || place.at.y >= level.rows) return;
    const data::SampleRange samples = samples_of(ground.grid, level, place.at.x, place.at.y);
    if (!sides.may_meet(samples)) return;
    if (sides.contains(samples)) {
        const data::HeightExtremes::Block& block = level.blocks[level.index(place.at.x, place.at.y)];
        cover.any_valid |= block.any_valid;
        cover.any_void |= block.any_void;
        return;
    }
    if (place.level + 1 < ground.extremes.levels.size()) {
        for (int i = 0; i < 4; ++i)
            gather_voids(ground, sides, rows, {place.level + 1, 2 * place.at + glm::ivec2(i & 1, i >> 1)},
                         cover);
        return;
    }
    for (int y = std::max(samples.min.y, rows.first_row()); y <= std::min(samples.max.y, rows.last_row());
         ++y) {
        int first = 0, last = 0;
        if (!rows.span(y, first, last)) continue;
        for (int x = std::max(first, samples.min.x); x <= std::min(last, samples.max.x); ++x)
            (ground.grid.void_at(x, y) ? cover.any_void : cover.any_valid) = true;
    }
}

template <typename WorstOf>
TriangleError clamped_error(const data::HeightGrid& grid, const Domain& domain, const TriangleCorners& t,
                            const WorstOf& worst_of) {
    const GridPoint a = domain.clamped(t.apex), l = domain.clamped(t.left), r = domain.clamped(t.right);
    if (is_degenerate(a, l, r)) return {};
    const double ha = double(grid.at(a.x, a.y));
    const double hl = double(grid.at(l.x, l.y)) - ha, hr = double(grid.at(r.x, r.y)) - ha;
    const double lx = l.x - a.x, ly = l.y - a.y, rx = r.x - a.x, ry = r.y - a.y;
    const double area = lx * ry - rx * ly;
    const glm::dvec2 gradient((hl * ry - hr * ly) / area, (hr * lx - hl * rx) / area);
    const float worst = worst_of({a, l, r}, ClampedRows(RowSpans(a, l, r), a, ha, gradient));
    // The gradient itself is rounded here: up to 2^-24 of it for every cell of the widest row.
    const float slack = static_cast<float>(std::abs(gradient.x) * domain.width * 0x1p-23);
    const float scale = std::max({std::abs(float(ha)), std::abs(float(ha + hl)), std::abs(float(ha + hr))});
    return {worst == 0.0f ? 0.0f : with_rounding(worst, scale) + slack, static_cast<float>(gradient.x),
            static_cast<float>(gradient.y)};
}

}  // namespace

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
__attribute__((target_clones("avx2", "default")))
#endif
float max_residual(const float* samples, int count, float first, float gradient) {
    float worst = 0.0f;
    int i = 0;
    if (count >= kLaneCount) {
        const Lanes step = {0, 1, 2, 3, 4, 5, 6, 7};
        Lanes worst_lanes = {};
        for (; i + kLaneCount <= count; i += kLaneCount) {
            Lanes sample;
            std::memcpy(&sample, samples + i, sizeof(sample));
            const Lanes plane = first + gradient * (static_cast<float>(i) + step);
            const Lanes difference = sample - plane;
            const Lanes size = difference < 0.0f ? -difference : difference;
            worst_lanes = size > worst_lanes ? size : worst_lanes;
        }
        for (int lane = 0; lane < kLaneCount; ++lane)
            worst = std::max(worst, worst_lanes[lane]);
    }
    for (; i < count; ++i) {
        worst = std::max(worst, std::abs(samples[i] - (first + gradient * static_cast<float>(i))));
    }
    return worst;
}

TriangleError regular_triangle_error(const data::HeightGrid& grid, const TriangleCorners& corners) {
    return regular_error(grid, corners, Scan{grid});
}

TriangleError clamped_triangle_error(const data::HeightGrid& grid, const Domain& domain,
                                     const TriangleCorners& corners) {
    return clamped_error(grid, domain, corners, Scan{grid});
}

TriangleError find_triangle_error(const SearchedGround& ground, const Domain& domain,
                                  const TriangleCorners& corners, uint64_t& samples) {
    const bool is_inside =
        domain.in_raster(corners.apex) && domain.in_raster(corners.left) && domain.in_raster(corners.right);
    const Search search{ground.grid, ground.extremes, samples};
    return is_inside ? regular_error(ground.grid, corners, search)
                     : clamped_error(ground.grid, domain, corners, search);
}

VoidCover void_cover(const data::HeightGrid& grid, const Domain& domain, const TriangleCorners& t) {
    VoidCover cover;
    const GridPoint a = domain.clamped(t.apex), l = domain.clamped(t.left), r = domain.clamped(t.right);
    if (is_degenerate(a, l, r)) return cover;
    const RowSpans rows(a, l, r);
    for (int y = rows.first_row(); y <= rows.last_row() && !(cover.any_valid && cover.any_void); ++y) {
        int x = 0, x_last = 0;
        if (!rows.span(y, x, x_last)) continue;
        for (; x <= x_last; ++x)
            (grid.void_at(x, y) ? cover.any_void : cover.any_valid) = true;
    }
    return cover;
}

VoidCover find_void_cover(const SearchedGround& ground, const Domain& domain, const TriangleCorners& t) {
    VoidCover cover;
    const GridPoint a = domain.clamped(t.apex), l = domain.clamped(t.left), r = domain.clamped(t.right);
    if (is_degenerate(a, l, r)) return cover;
    gather_voids(ground, TriangleSides(a, l, r), RowSpans(a, l, r), {0, {0, 0}}, cover);
    return cover;
}

}  // namespace terrain
