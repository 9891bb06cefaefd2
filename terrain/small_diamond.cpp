#include "terrain/small_diamond.h"

#include <algorithm>
#include <cmath>

#include "terrain/regular_triangle.h"

namespace terrain {
namespace {

constexpr int kMostReach = 2;

/// Heights around a diamond's centre, which is (0, 0).
struct NearHeights {
    const float* centre;
    std::ptrdiff_t pitch;  ///< samples a row

    [[gnu::always_inline]] float at(int x, int y) const { return centre[y * pitch + x]; }
};

/// Looks at every sample of a few.
struct ShortScan {
    const NearHeights& heights;

    template <typename Rows>
    [[gnu::always_inline]] float operator()(const TriangleCorners&, const Rows& rows) const {
        float worst_m = 0.0f;
#pragma GCC unroll 8
        for (int y = rows.first_y; y <= rows.last_y; ++y) {
            SampleRow row;
            rows.at(y, row);
#pragma GCC unroll 8
            for (int i = 0; i < row.count; ++i) {
                const float plane_m = row.first_m + rows.gradient * static_cast<float>(i);
                worst_m = std::max(worst_m, std::abs(heights.at(row.x + i, y) - plane_m));
            }
        }
        return worst_m;
    }
};

template <int apex_dir, int reach>
[[gnu::always_inline]] inline float half_error_m(const FactsPass& pass, const NearHeights& heights) {
    constexpr auto corner = [](int dir) { return GridPoint{kDirX[dir & 7] * reach, kDirY[dir & 7] * reach}; };
    constexpr TriangleCorners t{corner(apex_dir), corner(apex_dir + 2), corner(apex_dir - 2)};
    const TriangleError error = regular_error(heights, t, ShortScan{heights});
    return error.residual_m + chord_error_m(pass, error);
}

template <int apex_dir, int reach>
[[gnu::always_inline]] inline DiamondSource facts(const FactsPass& pass, const NearHeights& heights) {
    DiamondSource source;
    source.height_m = heights.at(0, 0);
    float rise_m = 0.0f;
#pragma GCC unroll 4
    for (int corner = 0; corner < 4; ++corner) {
        const int dir = (apex_dir + 2 * corner) & 7;
        rise_m =
            std::max(rise_m, std::abs(heights.at(kDirX[dir] * reach, kDirY[dir] * reach) - source.height_m));
    }
    source.set_rise(rise_m);
    source.error_code = encode_length(std::max(half_error_m<apex_dir, reach>(pass, heights),
                                               half_error_m<apex_dir + 4, reach>(pass, heights)));
    return source;
}

template <int reach>
DiamondSource facts_of(const FactsPass& pass, GridPoint centre) {
    const NearHeights heights{&pass.grid.height_m[pass.grid.index(centre.x, centre.y)], pass.grid.width};
    switch (apex_direction(pass.domain, centre, pass.level)) {
        case 0:
            return facts<0, reach>(pass, heights);
        case 1:
            return facts<1, reach>(pass, heights);
        case 2:
            return facts<2, reach>(pass, heights);
        default:
            return facts<3, reach>(pass, heights);
    }
}

}  // namespace

bool is_small(const FactsPass& pass, GridPoint centre) {
    const int reach = pass.reach;
    return reach <= kMostReach && centre.x >= reach && centre.y >= reach &&
           centre.x + reach < pass.grid.width && centre.y + reach < pass.grid.height &&
           !pass.grid.has_voids();
}

DiamondSource small_facts(const FactsPass& pass, GridPoint centre) {
    return pass.reach == 1 ? facts_of<1>(pass, centre) : facts_of<2>(pass, centre);
}

}  // namespace terrain
