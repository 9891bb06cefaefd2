#include "data/ground_height.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "lod/base/rng.h"
#include "tests/data/relief.h"

namespace {

using data::HeightGrid;

// The two triangles of a cell, written out by hand from the rule, searched one after the other.
data::GroundHeight by_triangles(const HeightGrid& grid, double col, double row) {
    for (int y = 0; y + 1 < grid.height; ++y) {
        for (int x = 0; x + 1 < grid.width; ++x) {
            const glm::ivec2 nw(x, y), ne(x + 1, y), sw(x, y + 1), se(x + 1, y + 1);
            const bool is_even = (x + y) % 2 == 0;
            const std::array<std::array<glm::ivec2, 3>, 2> triangles =
                is_even ? std::array<std::array<glm::ivec2, 3>, 2>{{{nw, se, ne}, {nw, se, sw}}}
                        : std::array<std::array<glm::ivec2, 3>, 2>{{{ne, sw, nw}, {ne, sw, se}}};
            for (const auto& t : triangles) {
                const glm::dvec2 a(t[0]), b(t[1]), c(t[2]), p(col, row);
                const auto area = [](glm::dvec2 u, glm::dvec2 v) { return u.x * v.y - u.y * v.x; };
                const double all = area(b - a, c - a);
                const double wa = area(b - p, c - p) / all, wb = area(c - p, a - p) / all,
                             wc = area(a - p, b - p) / all;
                if (std::min({wa, wb, wc}) < 0.0) continue;
                data::GroundHeight out{0.0, true};
                for (int k = 0; k < 3; ++k) {
                    const glm::ivec2 corner = t[static_cast<size_t>(k)];
                    out.height_m += (k == 0 ? wa : k == 1 ? wb : wc) * double{grid.at(corner.x, corner.y)};
                    out.valid = out.valid && !grid.void_at(corner.x, corner.y);
                }
                return out;
            }
        }
    }
    return {};
}

TEST(GroundHeight, IsTheHeightOfTheBintreeTriangles) {
    lod::Rng rng(8);
    std::vector<float> heights(7 * 5);
    for (float& h : heights)
        h = static_cast<float>(rng.between(-50, 500));
    HeightGrid grid = data::make_planar_grid(7, 5, 10.0, heights);
    grid.is_void.assign(35, 0);
    grid.is_void[grid.index(4, 2)] = 1;
    for (int i = 0; i < 5000; ++i) {
        const double col = rng.between(-0.5, 6.5), row = rng.between(-0.5, 4.5);
        const data::GroundHeight truth = by_triangles(grid, col, row),
                                 ours = data::ground_height(grid, col, row);
        ASSERT_EQ(ours.valid, truth.valid) << col << ' ' << row;
        if (truth.valid) {
            ASSERT_NEAR(ours.height_m, truth.height_m, 1e-9) << col << ' ' << row;
        }
    }
    for (int row = 0; row < 5; ++row) {
        for (int col = 0; col < 7; ++col) {
            const data::GroundHeight corner = data::ground_height(grid, col, row);
            if (corner.valid) {
                EXPECT_EQ(corner.height_m, double{grid.at(col, row)});
            }
        }
    }
    EXPECT_FALSE(data::ground_height(grid, NAN, 1).valid);
    EXPECT_FALSE(data::ground_height(grid, 6.0001, 1).valid);
    EXPECT_TRUE(data::ground_height(grid, 6.0, 4.0).valid);
}

TEST(GroundHeight, PlanarGridLiesWhereItSays) {
    const HeightGrid grid = data::make_planar_grid(3, 4, 5.0, std::vector<float>(12, 7.0f));
    EXPECT_EQ(grid.frame.world_from_sample(0, 0, 7), glm::dvec3(0, 15, 7));
    EXPECT_EQ(grid.frame.world_from_sample(2, 3, 7), glm::dvec3(10, 0, 7));
    EXPECT_EQ(grid.min_m, 7.0f);
    EXPECT_FALSE(grid.has_voids());
}

}  // namespace
