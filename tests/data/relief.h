// What the tests of the height readers share: a relief known everywhere, and reading with the outcome checked.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "data/height_grid.h"
#include "tests/data/raster_writer.h"

namespace test {

using data::HeightGrid;
using data::HeightGridOptions;
using data::VoidPolicy;

inline constexpr HeightGridOptions kHoles{.voids = VoidPolicy::kHole};

inline HeightGrid read(const std::vector<std::string>& paths, const HeightGridOptions& options = kHoles) {
    auto grid = data::read_height_grid(paths, options);
    EXPECT_TRUE(grid) << grid.message();
    return grid ? std::move(*grid) : data::make_planar_grid(2, 2, 1.0, {0, 0, 0, 0});
}

inline std::string failure(const std::vector<std::string>& paths) {
    const auto grid = data::read_height_grid(paths, {});
    EXPECT_FALSE(grid) << paths[0];
    return grid ? std::string() : grid.message();
}

// A relief that is a function of the site, so that any raster of it can be checked anywhere.
inline double relief(double x, double y) {
    return 800.0 + 300.0 * std::sin(9.0 * x) + 250.0 * std::cos(7.0 * y) + 40.0 * x;
}

inline RasterSpec relief_spec(int width, int height, const std::array<double, 6>& g) {
    RasterSpec spec{.width = width, .height = height, .geo_transform = g};
    for (int row = 0; row < height; ++row) {
        for (int col = 0; col < width; ++col) {
            spec.values.push_back(relief(g[0] + (col + 0.5) * g[1] + (row + 0.5) * g[2],
                                         g[3] + (col + 0.5) * g[4] + (row + 0.5) * g[5]));
        }
    }
    return spec;
}

inline size_t count_voids(const HeightGrid& grid) {
    return static_cast<size_t>(std::count(grid.is_void.begin(), grid.is_void.end(), 1));
}

inline void expect_invariants(const HeightGrid& grid) {
    ASSERT_EQ(grid.height_m.size(), static_cast<size_t>(grid.width) * static_cast<size_t>(grid.height));
    const auto [low, high] = std::minmax_element(grid.height_m.begin(), grid.height_m.end());
    EXPECT_GE(*low, grid.min_m);
    EXPECT_LE(*high, grid.max_m);
    EXPECT_TRUE(
        std::all_of(grid.height_m.begin(), grid.height_m.end(), [](float h) { return std::isfinite(h); }));
    if (grid.has_voids()) {
        EXPECT_EQ(grid.is_void.size(), grid.height_m.size());
        EXPECT_GT(count_voids(grid), 0u);
    }
}

// Every valid sample is what the relief says at its site.
inline void expect_relief(const HeightGrid& grid, double tolerance_m) {
    double worst = 0.0;
    for (int row = 0; row < grid.height; ++row) {
        for (int col = 0; col < grid.width; ++col) {
            if (grid.void_at(col, row)) continue;
            const data::SitePoint site = grid.frame.site_from_grid(col, row);
            worst = std::max(worst, std::abs(double{grid.at(col, row)} - relief(site.x, site.y)));
        }
    }
    EXPECT_LE(worst, tolerance_m);
}

}  // namespace test
