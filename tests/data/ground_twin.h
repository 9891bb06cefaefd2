// GroundTwin: the ground's surface once more, written out from the rule alone; and grids to ask it about.
#pragma once

#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "data/height_grid.h"
#include "lod/base/rng.h"

namespace test {

/// A grid of random relief anywhere on the Earth.
/// @param crs  empty: planar
inline data::HeightGrid rough_grid(int width, int height, const std::array<double, 6>& geo_transform,
                                   const std::string& crs, double relief_m) {
    data::HeightGrid grid;
    grid.width = width;
    grid.height = height;
    lod::Rng rng(static_cast<uint64_t>(width * 1000 + height));
    for (int i = 0; i < width * height; ++i) {
        const double wave = std::sin(0.31 * (i % width)) * std::cos(0.23 * (i / width));
        grid.height_m.push_back(static_cast<float>(relief_m * (0.5 + 0.4 * wave + rng.between(0.0, 0.1))));
    }
    grid.min_m = *std::min_element(grid.height_m.begin(), grid.height_m.end());
    grid.max_m = *std::max_element(grid.height_m.begin(), grid.height_m.end());
    auto frame = data::GroundFrame::make(geo_transform, crs, width, height);
    EXPECT_TRUE(frame) << frame.message();
    grid.frame = *frame;
    return grid;
}

struct TwinHeight {
    bool is_inside = false, is_void = false;
    double height_m = NAN;
};

/// Searches the two triangles of the one cell.
inline TwinHeight twin_height(const data::HeightGrid& grid, double col, double row) {
    if (!(col >= 0 && row >= 0 && col <= grid.width - 1 && row <= grid.height - 1)) return {};
    const int x = std::min(static_cast<int>(std::floor(col)), grid.width - 2);
    const int y = std::min(static_cast<int>(std::floor(row)), grid.height - 2);
    const std::array<glm::ivec2, 4> around = {
        {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}};  // from the north-west, clockwise
    const size_t even = (x + y) % 2 == 0 ? 0 : 1;           // the cut joins this corner and the opposite one
    const glm::dvec2 p(col, row);
    for (size_t side : {even + 1, (even + 3) % 4}) {
        const glm::ivec2 a = around[even], b = around[even + 2], c = around[side];
        const glm::dmat2 axes(glm::dvec2(b - a), glm::dvec2(c - a));
        const glm::dvec2 w = glm::inverse(axes) * (p - glm::dvec2(a));
        if (w.x < -1e-12 || w.y < -1e-12 || w.x + w.y > 1.0 + 1e-12) continue;
        const double h = (1.0 - w.x - w.y) * double(grid.at(a.x, a.y)) + w.x * double(grid.at(b.x, b.y)) +
                         w.y * double(grid.at(c.x, c.y));
        return {true, grid.void_at(a.x, a.y) || grid.void_at(b.x, b.y) || grid.void_at(c.x, c.y), h};
    }
    ADD_FAILURE() << "no triangle at " << col << ", " << row;
    return {};
}

/// Column, row and height of a world point, by GeographicLib and the geotransform, for rasters in degrees.
inline glm::dvec3 twin_place(const std::array<double, 6>& g, double width, const glm::dvec3& world) {
    double latitude = 0.0, longitude = 0.0, height_m = 0.0;
    GeographicLib::Geocentric::WGS84().Reverse(world.x, world.y, world.z, latitude, longitude, height_m);
    const double middle = g[0] + g[1] * width * 0.5;
    while (longitude < middle - 180.0)
        longitude += 360.0;
    while (longitude > middle + 180.0)
        longitude -= 360.0;
    return {(longitude - g[0]) / g[1] - 0.5, (latitude - g[3]) / g[5] - 0.5, height_m};
}

inline const std::array<double, 6> kPlanarTransform = {-5.0, 10.0, 0.0, 500.0, 0.0, -10.0};

}  // namespace test
