// `terrain compare`: its report is whole, and its figures are those that an independent count finds.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "data/fractal_grid.h"
#include "sim/compare/calibrate.h"
#include "sim/compare/comparison_report.h"
#include "sim/compare/sorties.h"
#include "sim/compare/surface.h"
#include "sim/compare/surface_history.h"
#include "terrain/drawn/conformity.h"
#include "tests/sim/program.h"
#include "tests/terrain/picture_point.h"
#include "tests/terrain/vertical_probe.h"

namespace {

using nlohmann::json;
using terrain::DrawnTriangle;

constexpr int kSide = 385;
constexpr double kCell_m = 1.0, kRelief_m = 60.0;

/// The relief, its table, and every method over it.
struct Bench {
    data::HeightGrid grid = data::fractal_grid(kSide, kSide, kCell_m, kRelief_m, 1);
    terrain::DiamondTable table = terrain::make_diamond_table(grid, 2);
    std::vector<sim::Method> methods = sim::make_methods(grid, table, 0.0, {.threads = 2, .only = {}});
    std::vector<lod::View> views =
        sim::calibration_views(sim::plan_sorties(grid, {.frames = 20, .incoherent = 1}));
};

/// By searching, in world coordinates, what is straight above or below each sample.
double probed_px(const data::HeightGrid& grid, const lod::View& view,
                 const std::vector<DrawnTriangle>& triangles) {
    const auto ground = terrain::drawn::without_skirts(triangles);
    const terrain_test::VerticalProbe probe(grid.width, grid.height, kCell_m, ground);
    double worst_px = 0.0;
    for (int row = 0; row < grid.height; ++row) {
        for (int col = 0; col < grid.width; ++col) {
            const glm::dvec3 world(col * kCell_m, (grid.height - 1 - row) * kCell_m,
                                   double(grid.at(col, row)));
            const glm::dvec3 at = terrain_test::projected(view, world);
            if (!terrain_test::is_in_picture(view, at)) continue;
            const auto hit = probe.probe(col, row, world, {0.0, 0.0, 1.0});
            EXPECT_TRUE(hit.found) << col << ", " << row;
            const glm::dvec3 drawn = terrain_test::projected(view, world + glm::dvec3(0, 0, hit.above_m));
            worst_px = std::max(worst_px, std::hypot(drawn.x - at.x, drawn.y - at.y));
        }
    }
    return worst_px;
}

TEST(Compare, ErrorsAreEqualAsAnIndependentCountFinds) {
    Bench bench;
    ASSERT_EQ(bench.methods.size(), 7u);
    for (sim::Method& method : bench.methods) {
        for (const double target_px : {1.0, 4.0}) {
            SCOPED_TRACE(method.name + ", " + std::to_string(target_px) + " px");
            const sim::Calibration found = sim::calibrate(method, bench.grid, bench.views, target_px, 2);
            double probed = 0.0;
            for (const lod::View& view : bench.views) {
                sim::restart(method, found.tolerance_px, 0);
                sim::adapt(method, view, 0.0, found.tolerance_px);
                probed = std::max(probed, probed_px(bench.grid, view, sim::triangles_of(method)));
            }
            // At a seam with a skirt two surfaces meet; the probe takes the one it finds first.
            EXPECT_LE(probed, found.measured_px * 1.001);
            EXPECT_GE(probed, found.measured_px * (method.has_skirts ? 0.5 : 0.999));
            EXPECT_NEAR(found.measured_px, target_px, 0.05 * target_px);
        }
    }
}

/// A flat sheet of two triangles a cell.
std::vector<DrawnTriangle> sheet(int cells, double height_m) {
    std::vector<DrawnTriangle> out;
    const auto corner = [&](int col, int row) { return glm::dvec3(col, cells - row, height_m); };
    for (int row = 0; row < cells; ++row) {
        for (int col = 0; col < cells; ++col) {
            const terrain::GridPoint nw{col, row}, ne{col + 1, row}, sw{col, row + 1}, se{col + 1, row + 1};
            out.push_back({{corner(col, row), corner(col, row + 1), corner(col + 1, row + 1)}, {nw, sw, se}});
            out.push_back({{corner(col, row), corner(col + 1, row + 1), corner(col + 1, row)}, {nw, se, ne}});
        }
    }
    return out;
}

/// From straight above, `above_m` over the sheet's middle.
lod::View from_above(double middle, double above_m) {
    lod::View view;
    view.eye_world = {middle, middle, above_m};
    view.width_px = view.height_px = 400;
    return view;
}

TEST(Compare, EverySampleOfATilingBelongsToOneTriangle) {
    constexpr int kCells = 6;
    std::vector<int> owners((kCells + 1) * (kCells + 1), 0);
    for (const DrawnTriangle& t : sheet(kCells, 0.0)) {
        sim::for_samples_under(t, sim::EdgeRule::kOne, [&](int col, int row) {
            ++owners[static_cast<size_t>(row * (kCells + 1) + col)];
        });
    }
    for (int row = 1; row < kCells; ++row) {
        for (int col = 1; col < kCells; ++col)
            EXPECT_EQ(owners[static_cast<size_t>(row * (kCells + 1) + col)], 1) << col << ", " << row;
    }
}

TEST(Compare, CountsWhatChangedAndHowFarItJumped) {
    constexpr int kCells = 8;
    const data::HeightGrid flat =
        data::make_planar_grid(kCells + 1, kCells + 1, 1.0, std::vector<float>((kCells + 1) * (kCells + 1)));
    const lod::View view = from_above(kCells / 2.0, 100.0);
    sim::SurfaceHistory history(flat);
    EXPECT_EQ(history.add(view, sheet(kCells, 0.0)).changed_share, 0.0);
    const sim::SurfaceChange same = history.add(view, sheet(kCells, 0.0));
    EXPECT_EQ(same.changed_share, 0.0);
    EXPECT_EQ(same.popping_px, 0.0);

    // One vertex goes up 2 m: no triangle has other samples, six have other places.
    std::vector<DrawnTriangle> dented = sheet(kCells, 0.0);
    for (DrawnTriangle& t : dented) {
        for (size_t i = 0; i < 3; ++i) {
            if (t.samples[i].x == 2 && t.samples[i].y == 5) t.world[i].z = 2.0;
        }
    }
    const sim::SurfaceChange up = history.add(view, dented);
    EXPECT_EQ(up.changed_share, 0.0);
    const double lambda_px = view.height_px / (2.0 * std::tan(view.fov_y_rad / 2.0));
    const double beside_m = std::hypot(2.0 - kCells / 2.0, kCells - 5.0 - kCells / 2.0);
    EXPECT_NEAR(up.popping_px, lambda_px * beside_m * (1.0 / 98.0 - 1.0 / 100.0), 1e-6);

    // Half of the sheet goes and comes back: new triangles, but nothing there to jump from.
    history.add(view, sheet(kCells, 0.0));
    std::vector<DrawnTriangle> half = sheet(kCells, 0.0);
    half.resize(half.size() / 2);
    EXPECT_EQ(history.add(view, half).changed_share, 0.0);
    const sim::SurfaceChange back = history.add(view, sheet(kCells, 5.0));
    EXPECT_EQ(back.changed_share, 0.5);
    EXPECT_GT(back.popping_px, 0.0) << "the other half has jumped";
}

TEST(Compare, ReportIsWholeAndRoamDrawsTheFewest) {
    if (!sim_test::has_program()) GTEST_SKIP() << "harrier is not built in " HARRIER_BINARY_DIR;
    const sim_test::TempFolder folder;
    const std::string report = folder.file("compare.json");
    const auto outcome = sim_test::run_program(
        folder,
        "terrain compare --fractal 385 --relief 60 --frames 4 --targets 1,4 --threads 2 "
        "--report " +
            report);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const json said = json::parse(sim_test::read_all(report));
    ASSERT_EQ(said["rows"].size(), 2u * 7u);
    std::map<double, std::map<std::string, double>> triangles;
    for (const json& row : said["rows"]) {
        SCOPED_TRACE(row.dump());
        const std::string method = row["method"];
        for (const char* column :
             {"method", "target_px", "measured_px", "triangles", "cpu_us_p50", "cpu_us_p99", "frame_ms_p50",
              "commands", "upload_bytes", "changed_share", "popping_px", "memory_mb", "prepare_s"}) {
            ASSERT_TRUE(row.contains(column)) << column;
            EXPECT_FALSE(row[column].is_null()) << column;
        }
        // Whole chunks come and go: their error moves in steps.
        const double slack = method == "chunked_quadtree" ? 0.35 : 0.05;
        const double target_px = row["target_px"];
        EXPECT_NEAR(row["measured_px"].get<double>(), target_px, slack * target_px);
        EXPECT_LE(row["cpu_us_p50"].get<double>(), row["cpu_us_p99"].get<double>());
        EXPECT_LT(row["cpu_us_p50"].get<double>() / 1e3, row["frame_ms_p50"].get<double>());
        triangles[row["target_px"].get<double>()][method] = row["triangles"].get<double>();
    }
    for (const auto& [target_px, counts] : triangles) {
        for (const auto& [method, count] : counts) {
            // A mesh that may collapse any edge needs fewer; what else it needs is in the other columns.
            if (method.rfind("roam", 0) == 0 || method == "vdpm") continue;
            EXPECT_LT(counts.at("roam"), count) << method << " at " << target_px << " px";
        }
    }
    ASSERT_EQ(said["requirements"].size(), 7u);
    for (const json& row : said["requirements"]) {
        const double t_junctions = row["no_gaps_geometry"]["figure"];
        EXPECT_EQ(t_junctions > 0.0, row["method"] == "chunked_quadtree") << row["method"];
    }
}

TEST(Compare, SaysWhatIsLeftOut) {
    const data::HeightGrid large = data::make_planar_grid(1030, 1030, 1.0, std::vector<float>(1030 * 1030));
    sim::Comparison comparison;
    comparison.left_out = sim::left_out(large, {});
    comparison.rows.resize(1);
    EXPECT_NE(sim::table_of(comparison).find("| vdpm | too many samples |"), std::string::npos);
    const json rows = sim::json_of(comparison)["rows"];
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[1]["method"], "vdpm");
    EXPECT_TRUE(rows[1]["triangles"].is_null());
    EXPECT_TRUE(sim::left_out(large, {.only = {"roam"}}).empty());
}

TEST(Compare, WantsAReliefThatCanBeCompared) {
    if (!sim_test::has_program()) GTEST_SKIP() << "harrier is not built in " HARRIER_BINARY_DIR;
    const sim_test::TempFolder folder;
    EXPECT_EQ(sim_test::run_program(folder, "terrain compare").status, 2);
    EXPECT_EQ(sim_test::run_program(folder, "terrain compare none.tif").status, 1);
}

}  // namespace
