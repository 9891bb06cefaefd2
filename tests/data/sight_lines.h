// What the tests of lines of sight share: lines over a grid, and whether a place is on its surface.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "data/ground_height.h"
#include "data/line_of_sight.h"
#include "tests/data/ground_twin.h"

namespace test {

using data::HeightGrid;
using data::Sight;
using data::WorldLine;

inline constexpr double kTouch_m = 1e-6;  ///< what data/line_of_sight.h lets pass

inline Sight look(const HeightGrid& grid, const WorldLine& line) {
    return data::line_of_sight(grid, data::make_height_pyramid(grid, 1), line);
}

/// Between two places of the raster, each up to above_m above the ground.
inline WorldLine random_line(const HeightGrid& grid, lod::Rng& rng, double length_cells, double above_m) {
    const double col = rng.between(0.0, grid.width - 1.0), row = rng.between(0.0, grid.height - 1.0);
    const double angle = rng.between(0.0, 6.283185);
    const auto end = [&](double c, double r) {
        const double ground_m = data::ground_height(grid, c, r).height_m;
        return grid.frame.world_from_grid(c, r, ground_m + std::exp(rng.between(-4.0, std::log(above_m))));
    };
    return {end(col, row), end(std::clamp(col + length_cells * std::cos(angle), 0.0, grid.width - 1.0),
                               std::clamp(row + length_cells * std::sin(angle), 0.0, grid.height - 1.0))};
}

/// A place (column, row, height) where a line is blocked: on the surface, or below it on the raster's border.
inline void expect_on_ground(const HeightGrid& grid, const glm::dvec3& p, double noise_m) {
    const glm::dvec2 inside =
        glm::clamp(glm::dvec2(p), glm::dvec2(0.0), glm::dvec2(grid.width - 1, grid.height - 1));
    ASSERT_LE(glm::distance(inside, glm::dvec2(p)), 1e-6);
    const double above_m = p.z - twin_height(grid, inside.x, inside.y).height_m;
    const glm::dvec2 to_border = glm::min(inside, glm::dvec2(grid.width - 1, grid.height - 1) - inside);
    ASSERT_LE(above_m, kTouch_m + noise_m);
    if (std::min(to_border.x, to_border.y) > 1e-6) {
        ASSERT_GE(above_m, -kTouch_m - noise_m);
    }
}

}  // namespace test
