// A block's progressive mesh at every stop and with any fans: covers the block without a fold, its active vertices and
// triangles come first, and no sample is farther from it than the stop says. The oracle is brute force.
#include "terrain/rivals/progressive_block.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "terrain/rivals/border_fan.h"
#include "tests/terrain/test_relief.h"

namespace {

using terrain::CellTriangle;
using terrain::GridPoint;
using terrain::ProgressiveBlock;

/// Every sample on its own: border fans then matter as much as they can.
data::HeightGrid white_noise(int width, int height, uint64_t seed) {
    lod::Rng rng(seed);
    std::vector<float> heights;
    for (int i = 0; i < width * height; ++i)
        heights.push_back(static_cast<float>(rng.between(-10.0, 10.0)));
    return data::make_planar_grid(width, height, 10.0, std::move(heights));
}

std::vector<CellTriangle> drawn(const ProgressiveBlock& block, const ProgressiveBlock::Stop& stop,
                                const std::array<uint8_t, 4>& shift) {
    std::vector<CellTriangle> out;
    for (uint32_t i = 0; i < stop.triangles; ++i) {
        const auto& c = block.corners[i];
        for (const uint16_t vertex : c)
            EXPECT_LT(vertex, block.base_vertices + stop.splits) << "not active yet";
        terrain::fan_border(block.size, {block.place(c[0]), block.place(c[1]), block.place(c[2])}, shift,
                            [&](const CellTriangle& part) { out.push_back(part); });
    }
    return out;
}

/// The largest distance of a covered sample, by barycentric coordinates.
double worst_m(const data::HeightGrid& grid, const ProgressiveBlock& block, const CellTriangle& t) {
    const auto height_m = [&](int x, int y) {
        return double(grid.at(block.origin.x + x, block.origin.y + y));
    };
    const auto area = static_cast<double>(terrain::twice_area(t[0], t[1], t[2]));
    double worst = 0.0;
    const auto [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [top, bottom] = std::minmax({t[0].y, t[1].y, t[2].y});
    for (int y = top; y <= bottom; ++y) {
        for (int x = left; x <= right; ++x) {
            const GridPoint p{x, y};
            const auto u = static_cast<double>(terrain::twice_area(p, t[1], t[2]));
            const auto v = static_cast<double>(terrain::twice_area(t[0], p, t[2]));
            const auto w = static_cast<double>(terrain::twice_area(t[0], t[1], p));
            if (u < 0.0 || v < 0.0 || w < 0.0) continue;
            const double plane_m =
                (u * height_m(t[0].x, t[0].y) + v * height_m(t[1].x, t[1].y) + w * height_m(t[2].x, t[2].y)) /
                area;
            worst = std::max(worst, std::abs(plane_m - height_m(x, y)));
        }
    }
    return worst;
}

/// Checks one stop with random fans, none coarser than the stop's own border; returns what was measured.
double check_stop(const data::HeightGrid& grid, const ProgressiveBlock& block, size_t index, lod::Rng& rng) {
    const ProgressiveBlock::Stop& stop = block.stops[index];
    double worst = 0.0;
    for (int i = 0; i < 3; ++i) {
        std::array<uint8_t, 4> shift = stop.border_shift;
        for (uint8_t& s : shift)
            s = static_cast<uint8_t>(rng.below(s + uint64_t{1}));
        int64_t area = 0;
        for (const CellTriangle& t : drawn(block, stop, shift)) {
            EXPECT_GT(terrain::twice_area(t[0], t[1], t[2]), 0);
            area += terrain::twice_area(t[0], t[1], t[2]);
            worst = std::max(worst, worst_m(grid, block, t));
        }
        EXPECT_EQ(area, int64_t{2} * block.size.x * block.size.y);
    }
    EXPECT_LE(worst, double(stop.error_m) + 1e-5) << "stop " << index;
    return worst;
}

void check_block(const data::HeightGrid& grid, GridPoint origin, GridPoint size) {
    ProgressiveBlock block = terrain::make_progressive_block(grid, origin, size);
    ASSERT_FALSE(block.stops.empty());
    const ProgressiveBlock::Stop full = block.stops.back();
    EXPECT_EQ(full.triangles, static_cast<uint32_t>(2 * size.x * size.y));
    EXPECT_EQ(block.base_vertices + full.splits, static_cast<uint32_t>((size.x + 1) * (size.y + 1)));
    EXPECT_EQ(full.error_m, 0.0f);
    EXPECT_EQ(block.stops.front().splits, 0u);
    EXPECT_EQ(block.stops.front().triangles, 2u);
    lod::Rng rng(1);
    const auto coarsest = block.corners;
    for (size_t i = 0; i < block.stops.size(); ++i) {
        if (i > 0) block.move(block.stops[i - 1], block.stops[i]);
        check_stop(grid, block, i, rng);
        if (testing::Test::HasFailure()) return;
    }
    block.move(block.stops.back(), block.stops.front());
    EXPECT_EQ(block.corners, coarsest);
}

TEST(ProgressiveBlock, EveryStopKeepsItsWordWhateverTheFans) {
    check_block(white_noise(17, 17, 1), {0, 0}, {16, 16});
    check_block(white_noise(40, 30, 2), {16, 16}, {13, 7});
    check_block(terrain_test::fractal_grid(33, 33, 10.0, 100.0, 3), {0, 0}, {32, 32});
    check_block(white_noise(9, 3, 4), {0, 0}, {8, 2});
    check_block(white_noise(3, 3, 5), {1, 1}, {1, 1});
}

TEST(ProgressiveBlock, FlatGroundIsTwoTriangles) {
    const auto grid = data::make_planar_grid(33, 33, 10.0, std::vector<float>(33 * 33, 5.0f));
    const ProgressiveBlock block = terrain::make_progressive_block(grid, {0, 0}, {32, 32});
    EXPECT_EQ(block.stops.size(), 2u);
    EXPECT_EQ(block.stops.front().triangles, 2u);
    EXPECT_EQ(block.stops.front().error_m, 0.0f);
}

}  // namespace
