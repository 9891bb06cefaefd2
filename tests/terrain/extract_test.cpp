// The static mesh: its error is measured at every sample against the triangles it handed out, its size against
// every other mesh there could be.
#include "terrain/extract.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

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
        const terrain::ExtractedMesh mesh = terrain::extract(grid, limit);
        const double measured = measured_error(grid, mesh);
        EXPECT_GE(measured, 0.0) << "a sample is not covered";
        EXPECT_NEAR(measured, mesh.max_error_m, 1e-9);
        EXPECT_LE(mesh.max_error_m, limit);
        EXPECT_GT(measured, 0.8 * limit) << "finer than asked for";
        EXPECT_LT(mesh.triangles.size(), last);
        last = mesh.triangles.size();
    }
}

TEST(Extract, ZeroIsEverySample) {
    const data::HeightGrid grid = terrain_test::fractal_grid(33, 20, 10.0, 50.0, 6);
    const terrain::ExtractedMesh mesh = terrain::extract(grid, 0.0);
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
    const terrain::ExtractedMesh mesh = terrain::extract(grid, 5.0);
    for (const auto& v : mesh.vertices)
        EXPECT_FALSE(grid.void_at(v.col, v.row));
    EXPECT_GT(mesh.triangles.size(), 100u);
    EXPECT_LE(mesh.max_error_m, 5.0);
    double area = 0.0;
    for (const auto& t : mesh.triangles) {
        const auto &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
        area -= 0.5 * (double(b.col - a.col) * (c.row - a.row) - double(c.col - a.col) * (b.row - a.row));
    }
    EXPECT_EQ(area, 64.0 * 64.0 - 41.0 * 21.0 + 2 * 0.5) << "all but the half cells that touch a void";
}

/// How many triangles lie on each side of an edge, by its ends.
std::map<std::pair<uint32_t, uint32_t>, int> edge_uses(const terrain::ExtractedMesh& mesh) {
    std::map<std::pair<uint32_t, uint32_t>, int> uses;
    for (const auto& t : mesh.triangles) {
        for (size_t k = 0; k < 3; ++k)
            ++uses[{t[k], t[(k + 1) % 3]}];
    }
    return uses;
}

TEST(Extract, HasNoCracks) {
    const data::HeightGrid grid = terrain_test::fractal_grid(150, 97, 10.0, 200.0, 8);
    const terrain::ExtractedMesh mesh = terrain::extract(grid, 4.0);
    const auto uses = edge_uses(mesh);
    for (const auto& [edge, count] : uses) {
        EXPECT_EQ(count, 1) << "two triangles on the same side";
        const auto &p = mesh.vertices[edge.first], &q = mesh.vertices[edge.second];
        const bool is_border = (p.col == q.col && (p.col == 0 || p.col == grid.width - 1)) ||
                               (p.row == q.row && (p.row == 0 || p.row == grid.height - 1));
        EXPECT_EQ(uses.count({edge.second, edge.first}), is_border ? 0u : 1u)
            << p.col << ' ' << p.row << " to " << q.col << ' ' << q.row;
    }
}

/// Every bintree mesh over 5 x 5 samples, as a set of split vertices: the twin that knows no order of splits.
struct AllMeshes {
    struct Corner {
        int col, row;
    };
    using Triangle = std::array<Corner, 3>;  // apex, left, right

    const data::HeightGrid& grid;
    double limit_m;
    uint32_t set = 0, met = 0;

    static uint32_t bit(Corner p) { return 1u << (p.row * 5 + p.col); }
    /// The vertex between two others; none, 0, between neighbours along an axis or a diagonal.
    static uint32_t between(Corner p, Corner q) {
        const bool is_whole = (p.col + q.col) % 2 == 0 && (p.row + q.row) % 2 == 0;
        return is_whole ? bit({(p.col + q.col) / 2, (p.row + q.row) / 2}) : 0;
    }

    /// Triangles of the set's mesh below this one; -1 when it has cracks or is farther from a sample than allowed.
    int triangles(const Triangle& t) {
        const auto& [apex, left, right] = t;
        if ((set & between(left, right)) != 0) {
            met |= between(left, right);
            const Corner middle{(left.col + right.col) / 2, (left.row + right.row) / 2};
            const int one = triangles({middle, apex, left});
            const int two = one < 0 ? -1 : triangles({middle, right, apex});
            return two < 0 ? -1 : one + two;
        }
        const bool is_split_across = (set & (between(apex, left) | between(apex, right))) != 0;
        return is_split_across || worst_m(t) > limit_m ? -1 : 1;
    }

    double worst_m(const Triangle& t) const {
        const auto& [a, b, c] = t;
        const double a_m = double(grid.at(a.col, a.row)), b_m = double(grid.at(b.col, b.row)),
                     c_m = double(grid.at(c.col, c.row));
        const double area = double(b.col - a.col) * (c.row - a.row) - double(c.col - a.col) * (b.row - a.row);
        double worst = 0.0;
        for (int row = 0; row < 5; ++row) {
            for (int col = 0; col < 5; ++col) {
                const double v = ((col - a.col) * (c.row - a.row) - (c.col - a.col) * (row - a.row)) / area;
                const double w = ((b.col - a.col) * (row - a.row) - (col - a.col) * (b.row - a.row)) / area;
                if (v < 0.0 || w < 0.0 || v + w > 1.0) continue;
                worst = std::max(
                    worst, std::abs(a_m + v * (b_m - a_m) + w * (c_m - a_m) - double(grid.at(col, row))));
            }
        }
        return worst;
    }

    /// Tries all sets of the 21 vertices that can be split.
    int smallest() {
        const uint32_t corners = bit({0, 0}) | bit({4, 0}) | bit({0, 4}) | bit({4, 4});
        int best = 33;
        for (set = 0; set < 1u << 24; ++set) {  // bit 24 is a corner
            if ((set & corners) != 0) continue;
            met = 0;
            const int one = triangles({{{0, 4}, {0, 0}, {4, 4}}});
            const int two = one < 0 ? -1 : triangles({{{4, 0}, {4, 4}, {0, 0}}});
            if (two >= 0 && met == set) best = std::min(best, one + two);
        }
        return best;
    }
};

TEST(Extract, NoOtherBintreeMeshIsSmaller) {
    for (uint64_t seed : {11u, 12u, 13u}) {
        const data::HeightGrid grid = terrain_test::fractal_grid(5, 5, 10.0, 40.0, seed);
        const double limit_m = 4.0 + 2.0 * double(seed - 11u);
        const auto mesh = terrain::extract(grid, limit_m);
        EXPECT_EQ(static_cast<int>(mesh.triangles.size()), (AllMeshes{grid, limit_m}.smallest())) << seed;
        EXPECT_GT(mesh.triangles.size(), 2u);
        EXPECT_LT(mesh.triangles.size(), 32u);
    }
}

}  // namespace
