// The static mesh: its error is measured at every sample against the triangles it handed out.
#include "terrain/extract.h"

#include <gtest/gtest.h>

#include "tests/terrain/test_relief.h"

namespace {

/// The largest vertical distance of any sample from the mesh, by brute force; -1 when a sample is not covered.
double measured_error(const data::HeightGrid& grid, const terrain::ExtractedMesh& mesh) {
    std::vector<double> worst(grid.height_m.size(), -1.0);
    for (const auto& t : mesh.triangles) {
        const auto &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
        const double area = double(b.col - a.col) * (c.row - a.row) - double(c.col - a.col) * (b.row - a.row);
        EXPECT_LT(area, 0.0) << "not counter-clockwise seen from above";
        for (int row = std::min({a.row, b.row, c.row}); row <= std::max({a.row, b.row, c.row}); ++row) {
            for (int col = std::min({a.col, b.col, c.col}); col <= std::max({a.col, b.col, c.col}); ++col) {
                const double v =
                    (double(col - a.col) * (c.row - a.row) - double(c.col - a.col) * (row - a.row)) / area;
                const double w =
                    (double(b.col - a.col) * (row - a.row) - double(col - a.col) * (b.row - a.row)) / area;
                if (v < -1e-12 || w < -1e-12 || v + w > 1.0 + 1e-12) continue;
                const double h = double(a.height_m) + v * double(b.height_m - a.height_m) +
                                 w * double(c.height_m - a.height_m);
                double& e = worst[grid.index(col, row)];
                e = std::max(e, std::abs(h - double(grid.at(col, row))));
            }
        }
    }
    return *std::min_element(worst.begin(), worst.end()) < 0.0
               ? -1.0
               : *std::max_element(worst.begin(), worst.end());
}

TEST(Extract, GuaranteesTheErrorAtEverySample) {
    const data::HeightGrid grid = terrain_test::fractal_grid(150, 97, 10.0, 200.0, 5);
    size_t last = SIZE_MAX;
    for (double limit : {0.5, 2.0, 8.0, 30.0}) {
        const terrain::ExtractedMesh mesh = terrain::extract(grid, limit, 2);
        const double measured = measured_error(grid, mesh);
        EXPECT_GE(measured, 0.0) << "a sample is not covered";
        EXPECT_LE(measured, mesh.max_error_m + 1e-4);
        EXPECT_LE(mesh.max_error_m, limit);
        EXPECT_GT(measured, 0.3 * limit) << "finer than asked for";
        EXPECT_LT(mesh.triangles.size(), last);
        last = mesh.triangles.size();
    }
}

TEST(Extract, ZeroIsEverySample) {
    const data::HeightGrid grid = terrain_test::fractal_grid(33, 20, 10.0, 50.0, 6);
    const terrain::ExtractedMesh mesh = terrain::extract(grid, 0.0, 1);
    EXPECT_EQ(mesh.triangles.size(), 2u * 32u * 19u);
    EXPECT_EQ(mesh.vertices.size(), 33u * 20u);
    EXPECT_EQ(mesh.max_error_m, 0.0);
}

TEST(Extract, HolesStayHoles) {
    data::HeightGrid grid = terrain_test::fractal_grid(65, 65, 10.0, 50.0, 7);
    grid.is_void.assign(grid.height_m.size(), 0);
    for (int row = 20; row < 40; ++row) {
        for (int col = 10; col < 50; ++col)
            grid.is_void[grid.index(col, row)] = 1;
    }
    const terrain::ExtractedMesh mesh = terrain::extract(grid, 5.0, 1);
    for (const auto& v : mesh.vertices)
        EXPECT_FALSE(grid.void_at(v.col, v.row));
    EXPECT_GT(mesh.triangles.size(), 100u);
}

}  // namespace
