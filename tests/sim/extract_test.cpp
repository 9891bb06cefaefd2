// `terrain extract`: its mesh against the raster, read here from the text the test wrote.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/sim/ply_reader.h"
#include "tests/sim/program.h"

namespace {

using nlohmann::json;
using sim_test::run_program;
using sim_test::TempFolder;
using sim_test::TriangleMesh;

double relief_m(int col, int row) {
    return 100 + (row * row + 3 * col) % 41;
}

/// Height of the mesh at x, y by searching every triangle.
double mesh_height(const TriangleMesh& mesh, double x, double y) {
    for (const auto& face : mesh.faces) {
        const auto& a = mesh.vertices[face[0]];
        const auto& b = mesh.vertices[face[1]];
        const auto& c = mesh.vertices[face[2]];
        const double area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        const double v = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / area;
        const double w = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / area;
        if (v < -1e-9 || w < -1e-9 || v + w > 1.0 + 1e-9) continue;
        return a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2]);
    }
    return NAN;
}

class Extract : public testing::TestWithParam<double> {};

TEST_P(Extract, NoSampleIsFartherThanPromised) {
    if (!sim_test::has_program()) GTEST_SKIP() << "harrier is not built in " HARRIER_BINARY_DIR;
    const TempFolder folder;
    const std::string dem = folder.write("relief.asc", sim_test::small_relief()), ply = folder.file("m.ply");
    const auto outcome = run_program(
        folder, "terrain extract " + dem + " --out " + ply + " --max-error " + std::to_string(GetParam()));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const json said = json::parse(outcome.out);
    const TriangleMesh mesh = sim_test::read_ply(ply);
    EXPECT_EQ(said["triangles"], mesh.faces.size());
    EXPECT_EQ(said["vertices"], mesh.vertices.size());
    EXPECT_LE(said["max_error_m"].get<double>(), GetParam());
    double worst_m = 0.0;
    for (int row = 0; row < 33; ++row) {
        for (int col = 0; col < 33; ++col) {
            const double there_m = mesh_height(mesh, 30.0 * (col + 0.5), 30.0 * (32.5 - row));
            ASSERT_FALSE(std::isnan(there_m)) << col << ", " << row;
            worst_m = std::max(worst_m, std::abs(there_m - relief_m(col, row)));
        }
    }
    EXPECT_LE(worst_m, said["max_error_m"].get<double>() + 1e-6);
    for (const auto& face : mesh.faces) {
        const auto& a = mesh.vertices[face[0]];
        const auto& b = mesh.vertices[face[1]];
        const auto& c = mesh.vertices[face[2]];
        EXPECT_GT((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]), 0.0) << "counter-clockwise";
    }
}

INSTANTIATE_TEST_SUITE_P(Errors, Extract, testing::Values(0.0, 3.0, 12.0, 100.0));

}  // namespace
