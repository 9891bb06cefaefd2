// The table of errors against a brute-force twin in double precision, and its codes against their promise.
#include "terrain/diamond_table.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/terrain/test_relief.h"

namespace {

using terrain::GridPoint;

/// max |sample - plane| over the samples of a triangle whose corners are clamped into the raster; 0 if squeezed.
double residual(const data::HeightGrid& grid, const terrain::Domain& domain, GridPoint p, GridPoint q,
                GridPoint r) {
    p = domain.clamped(p), q = domain.clamped(q), r = domain.clamped(r);
    const double area = double(q.x - p.x) * (r.y - p.y) - double(r.x - p.x) * (q.y - p.y);
    if (area == 0.0) return 0.0;
    double worst = 0.0;
    for (int y = std::min({p.y, q.y, r.y}); y <= std::max({p.y, q.y, r.y}); ++y) {
        for (int x = std::min({p.x, q.x, r.x}); x <= std::max({p.x, q.x, r.x}); ++x) {
            const double v = (double(x - p.x) * (r.y - p.y) - double(r.x - p.x) * (y - p.y)) / area;
            const double w = (double(q.x - p.x) * (y - p.y) - double(x - p.x) * (q.y - p.y)) / area;
            if (v < -1e-12 || w < -1e-12 || v + w > 1.0 + 1e-12) continue;
            const double h = double(grid.at(p.x, p.y)) * (1.0 - v - w) + double(grid.at(q.x, q.y)) * v +
                             double(grid.at(r.x, r.y)) * w;
            worst = std::max(worst, std::abs(h - double(grid.at(x, y))));
        }
    }
    return worst;
}

/// Walks all triangles of the bintree, down to cells, and gives each diamond the largest residual below it.
class Twin {
  public:
    Twin(const data::HeightGrid& grid, const terrain::Domain& domain) : grid_(grid), domain_(domain) {
        const int n = domain.side();
        visit(0, {0, n}, {0, 0}, {n, n});
        visit(0, {n, 0}, {n, n}, {0, 0});
    }
    std::map<std::tuple<int, int, int>, double>
        error;  ///< [level, y, x], not yet shared between the two halves

  private:
    double visit(int level, GridPoint apex, GridPoint left, GridPoint right) {
        if (level > domain_.finest_level()) return 0.0;
        const GridPoint middle{(left.x + right.x) / 2, (left.y + right.y) / 2};
        const double below =
            std::max(visit(level + 1, middle, apex, left), visit(level + 1, middle, right, apex));
        double& e = error[{level, middle.y, middle.x}];
        e = std::max({e, below, residual(grid_, domain_, apex, left, right)});
        return e;
    }
    const data::HeightGrid& grid_;
    terrain::Domain domain_;
};

void compare(int width, int height, double relief_m) {
    const data::HeightGrid grid = terrain_test::fractal_grid(width, height, 10.0, relief_m, 11);
    const terrain::DiamondTable table = terrain::make_diamond_table(grid, 2);
    const Twin twin(grid, table.domain);
    for (const auto& [key, expected] : twin.error) {
        const auto [level, y, x] = key;
        const int reach = table.domain.reach(level);
        if (x - reach >= width - 1 || y - reach >= height - 1) continue;  // covers no sample of its own
        const double found = double(table.at({x, y}, level).error_m());
        ASSERT_GE(found, expected - 1e-9)
            << "not a bound at level " << level << " (" << x << ", " << y << ")";
        if (level == table.domain.finest_level()) {  // nothing below it: exact but for rounding and the code
            ASSERT_LE(found, expected * 1.001 + 1e-3) << "looser than need be at (" << x << ", " << y << ")";
        }
    }
}

TEST(DiamondTable, BoundsEveryTriangleOfASquareRaster) {
    compare(65, 65, 300.0);
}
TEST(DiamondTable, BoundsEveryTriangleOfAnyRaster) {
    compare(50, 37, 300.0);
    compare(3, 90, 50.0);
    compare(2, 2, 50.0);
}

TEST(DiamondTable, APlaneHasNoError) {
    std::vector<float> heights;
    for (int row = 0; row < 33; ++row) {
        for (int col = 0; col < 33; ++col)
            heights.push_back(static_cast<float>(3 * col - 2 * row));
    }
    const data::HeightGrid grid = data::make_planar_grid(33, 33, 10.0, std::move(heights));
    for (const auto& source : terrain::make_diamond_table(grid, 1).slots)
        EXPECT_EQ(source.error_code, 0);
}

TEST(DiamondTable, CodesRoundUpByLittle) {
    for (float x = 1.3e-4f; x < 5e5f; x *= 1.0071f) {
        const float y = terrain::decode_length(terrain::encode_length(x));
        ASSERT_GE(y, x);
        ASSERT_LE(y, x * 1.0005f);
    }
    EXPECT_EQ(terrain::encode_length(0.0f), 0);
    EXPECT_GT(terrain::decode_length(terrain::encode_length(1e-30f)), 0.0f);
    EXPECT_GT(terrain::decode_length(terrain::encode_length(1e30f)), 5e5f);
}

TEST(DiamondTable, DoesNotDependOnThreads) {
    const data::HeightGrid grid = terrain_test::fractal_grid(129, 100, 10.0, 300.0, 3);
    const terrain::DiamondTable one = terrain::make_diamond_table(grid, 1),
                                four = terrain::make_diamond_table(grid, 4);
    for (size_t i = 0; i < one.slots.size(); ++i) {
        ASSERT_EQ(one.slots[i].error_code, four.slots[i].error_code);
        ASSERT_EQ(one.slots[i].rise_and_voids, four.slots[i].rise_and_voids);
    }
}

}  // namespace
