// What the tests of the rivals share: one relief with everything to make fronts over it, and views of it.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "lod/scheduler.h"
#include "terrain/rivals/rivals.h"
#include "tests/terrain/conformity.h"
#include "tests/terrain/drawn_mesh.h"
#include "tests/terrain/test_relief.h"

namespace terrain_test {

struct RivalRelief {
    data::HeightGrid grid;
    double spacing_m;
    terrain::DiamondTable table;

    RivalRelief(int width, int height, double spacing, double relief_m, uint64_t seed)
        : grid(fractal_grid(width, height, spacing, relief_m, seed)),
          spacing_m(spacing),
          table(terrain::make_diamond_table(grid, 1)) {}

    std::unique_ptr<terrain::RivalFront> front(terrain::Rival kind, double tolerance_px, int cells,
                                               unsigned threads = 1) const {
        return terrain::make_rival(kind, grid, table,
                                   {.tolerance_px = tolerance_px, .threads = threads, .block_cells = cells});
    }

    double width_m() const { return (grid.width - 1) * spacing_m; }
    double depth_m() const { return (grid.height - 1) * spacing_m; }

    /// The whole raster from so far above that nothing is culled.
    lod::View whole() const {
        return level_view({width_m() / 2.0, depth_m() / 2.0, 2.0 * (width_m() + depth_m()) + 5000.0}, 0.0,
                          -1.5707963);
    }
    /// Looks at some place of the relief, from near or far, sometimes from beyond its rim.
    lod::View random_view(lod::Rng& rng) const {
        const glm::dvec3 eye(
            rng.between(-0.2, 1.2) * width_m(), rng.between(-0.2, 1.2) * depth_m(),
            double(grid.max_m) + (rng.unit() < 0.7 ? rng.between(2, 300) : rng.between(300, 6000)));
        const glm::dvec3 target(rng.unit() * width_m(), rng.unit() * depth_m(), double(grid.min_m));
        return lod::look_at(eye, target, {0.0, 0.0, 1.0}, level_view({}, 0.0, 0.0));
    }
};

inline bool converge(lod::Front& front, const lod::View& view, double tolerance_px) {
    lod::Front* fronts[] = {&front};
    front.begin_frame({&view, 1}, 0.0);
    return lod::schedule(fronts, {.tolerance_px = tolerance_px}, lod::operation_limit(10'000'000)).converged;
}

/// What a test list calls a method.
inline std::string name_of(terrain::Rival kind) {
    return std::string(terrain::kRivals[static_cast<size_t>(kind)].name);
}

}  // namespace terrain_test
