// The promise of a converged picture: no DEM sample in view is farther from the drawn surface than error_px says.
//
// Judged from outside: samples come from GDAL, their places from PROJ and GeographicLib, the surface from the draw
// list. Each sample is projected, and so is the point of the drawn surface straight above or below it.
#include <gtest/gtest.h>

#include <fstream>
#include <ostream>
#include <span>
#include <vector>

#include "lod/scheduler.h"
#include "terrain/roam_front.h"
#include "tests/terrain/dem_truth.h"
#include "tests/terrain/picture_point.h"
#include "tests/terrain/vertical_probe.h"

namespace {

using terrain_test::DemTruth;
using terrain_test::DrawnTriangle;
using terrain_test::is_in_picture;
using terrain_test::projected;
using terrain_test::radians;
using terrain_test::TrueGround;
using terrain_test::VerticalHit;

/// Projected grids place samples within 1 mm, usually 0.1 mm: under 0.01 px beyond 10 m from the eye.
constexpr double kSlack_px = 0.01;

struct Source {
    const char* name;
    const char* path;  ///< from the project's root
    data::VoidPolicy voids;
};

/// Named in test lists by its name, not by the bytes of its pointers.
void PrintTo(const Source& source, std::ostream* out) {
    *out << source.name;
}

/// An eye over a place of the raster.
struct Pose {
    const char* name;
    double col_share, row_share, above_m;
    double heading_deg, pitch_deg, roll_deg, fov_deg;
    int width_px, height_px;
};

constexpr Pose kPoses[] = {
    {"low", 0.47, 0.52, 40, 30, -8, 0, 60, 1280, 720},
    {"high", 0.40, 0.22, 15000, 200, -70, 0, 60, 1280, 720},
    {"on its side", 0.30, 0.20, 300, 100, -5, 80, 60, 1280, 720},
    {"wide", 0.60, 0.40, 800, 250, -20, 15, 110, 1920, 1080},
    {"from the corner", 0.99, 0.99, 150, 315, -6, 0, 45, 1280, 720},
};
constexpr double kTolerances_px[] = {0.5, 1.0, 2.0, 4.0};

lod::View view_of(const DemTruth& dem, const Pose& pose) {
    const int col = static_cast<int>(pose.col_share * (dem.width - 1));
    const int row = static_cast<int>(pose.row_share * (dem.height - 1));
    double ground_m = 0.0;  // the highest around, so that no pose is inside a hill
    for (int y = std::max(row - 2, 0); y <= std::min(row + 2, dem.height - 1); ++y) {
        for (int x = std::max(col - 2, 0); x <= std::min(col + 2, dem.width - 1); ++x)
            ground_m = std::max(ground_m, dem.is_valid(x, y) ? dem.height_m[dem.index(x, y)] : 0.0);
    }
    const TrueGround at = dem.ground(col, row);
    const glm::dvec3 east = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), at.up));
    const glm::dmat3 world_from_enu(east, glm::cross(at.up, east), at.up);
    lod::View view;
    view.eye_world = at.base + at.up * (ground_m + pose.above_m);
    view.eye_from_world = lod::eye_from_attitude(world_from_enu, radians(pose.heading_deg),
                                                 radians(pose.pitch_deg), radians(pose.roll_deg));
    view.fov_y_rad = radians(pose.fov_deg);
    view.width_px = pose.width_px;
    view.height_px = pose.height_px;
    return view;
}

struct Sample {
    int col, row;
    glm::dvec3 world, up, picture;
};

std::vector<Sample> samples_in_view(const DemTruth& dem, const lod::View& view) {
    std::vector<Sample> out;
    for (int row = 0; row < dem.height; ++row) {
        for (int col = 0; col < dem.width; ++col) {
            if (!dem.is_valid(col, row)) continue;
            const TrueGround ground = dem.ground(col, row);
            const glm::dvec3 world = ground.base + ground.up * dem.height_m[dem.index(col, row)];
            const glm::dvec3 picture = projected(view, world);
            if (is_in_picture(view, picture)) out.push_back({col, row, world, ground.up, picture});
        }
    }
    return out;
}

/// On the rim of the raster or of a void, the drawn surface may end a little beside the sample.
bool is_on_rim(const DemTruth& dem, int col, int row) {
    for (int y = row - 1; y <= row + 1; ++y) {
        for (int x = col - 1; x <= col + 1; ++x) {
            if (!dem.contains(x, y) || !dem.is_valid(x, y)) return true;
        }
    }
    return false;
}

/// Whether some triangle of the full-resolution mesh with this corner has measurements at all its corners: cells
/// are cut along the diagonal that joins their even corners.
bool has_surface(const DemTruth& dem, int col, int row) {
    const auto valid = [&](int x, int y) { return dem.contains(x, y) && dem.is_valid(x, y); };
    for (int dx = -1; dx <= 1; dx += 2) {
        for (int dy = -1; dy <= 1; dy += 2) {
            const bool across = valid(col + dx, row + dy);
            const bool beside_x = valid(col + dx, row), beside_y = valid(col, row + dy);
            const bool is_even = ((col + row) & 1) == 0;
            if (is_even ? across && (beside_x || beside_y) : beside_x && beside_y) return true;
        }
    }
    return false;
}

struct Findings {
    double max_px = 0.0, beside_max_px = 0.0;
    size_t missing = 0, inner_beside = 0;
};

Findings measure(const DemTruth& dem, const lod::View& view, const std::vector<Sample>& samples,
                 const std::vector<DrawnTriangle>& triangles) {
    const double cell_m = glm::length(dem.ground(0, 0).base - dem.ground(0, 1).base);
    const terrain_test::VerticalProbe probe(dem.width, dem.height, cell_m, triangles);
    const double lambda_px = view.height_px / (2.0 * std::tan(view.fov_y_rad / 2.0));
    Findings findings;
    for (const Sample& sample : samples) {
        const VerticalHit hit = probe.probe(sample.col, sample.row, sample.world, sample.up);
        if (!hit.found) {
            if (has_surface(dem, sample.col, sample.row)) ++findings.missing;
            continue;
        }
        if (hit.beside_m > 0.0) {
            const double beside_px = lambda_px * hit.beside_m / sample.picture.z;
            const bool is_rim = is_on_rim(dem, sample.col, sample.row);
            if (!is_rim) ++findings.inner_beside;
            if (is_rim && !has_surface(dem, sample.col, sample.row)) continue;
            findings.beside_max_px = std::max(findings.beside_max_px, beside_px);
        }
        const glm::dvec3 drawn = projected(view, sample.world + sample.up * hit.above_m);
        const double px = drawn.z > 0.0 ? std::hypot(drawn.x - sample.picture.x, drawn.y - sample.picture.y)
                                        : std::numeric_limits<double>::infinity();
        findings.max_px = std::max(findings.max_px, px);
    }
    return findings;
}

/// Every drawn vertex lies on the sample it claims, as GDAL and GeographicLib place it.
double worst_vertex_m(const DemTruth& dem, const std::vector<DrawnTriangle>& triangles) {
    double worst = 0.0;
    for (const DrawnTriangle& triangle : triangles) {
        for (size_t i = 0; i < 3; ++i) {
            const terrain::GridPoint p = triangle.samples[i];
            if (!dem.is_valid(p.x, p.y)) continue;
            const TrueGround ground = dem.ground(p.x, p.y);
            const glm::dvec3 truth = ground.base + ground.up * dem.height_m[dem.index(p.x, p.y)];
            worst = std::max(worst, glm::length(truth - triangle.world[i]));
        }
    }
    return worst;
}

/// What is tried on one raster.
struct Trials {
    std::span<const Pose> poses;
    std::span<const double> tolerances_px;
    std::vector<int> batches;  ///< k
};

void expect_bound(const Source& source, const Trials& trials) {
    const std::string path = std::string(HARRIER_SOURCE_DIR) + "/" + source.path;
    if (!std::ifstream(path)) GTEST_SKIP() << path << " is not on this machine";
    DemTruth dem;
    ASSERT_TRUE(terrain_test::read_truth(path, dem));
    data::HeightGridOptions reading;
    reading.voids = source.voids;
    const auto grid = data::read_height_grid({path}, reading);
    ASSERT_TRUE(grid) << grid.message();
    const terrain::DiamondTable table = terrain::make_diamond_table(*grid, 2);

    for (const Pose& pose : trials.poses) {
        const lod::View view = view_of(dem, pose);
        const std::vector<Sample> samples = samples_in_view(dem, view);
        EXPECT_GT(samples.size(), 100u) << pose.name;
        for (const double tolerance_px : trials.tolerances_px) {
            for (const int batch : trials.batches) {
                SCOPED_TRACE(std::string(pose.name) + ", " + std::to_string(tolerance_px) + " px, k " +
                             std::to_string(batch));
                terrain::RoamFront front(table, {.tolerance_px = tolerance_px, .batch = batch});
                lod::Front* fronts[] = {&front};
                front.begin_frame({&view, 1}, 0.0);
                ASSERT_TRUE(
                    lod::schedule(fronts, {.tolerance_px = tolerance_px}, lod::operation_limit(10'000'000))
                        .converged);
                terrain_test::PoolTwin pool;
                const auto triangles = terrain_test::emit_triangles(front, view, pool);
                const Findings found = measure(dem, view, samples, triangles);
                std::printf(
                    "%-14s %-15s k %d tolerance %.1f: bound %.3f, measured %.3f px over %7zu samples, %6zu "
                    "triangles, rim beside %.3f px\n",
                    source.name, pose.name, batch, tolerance_px, front.error_px(), found.max_px,
                    samples.size(), triangles.size(), found.beside_max_px);
                EXPECT_EQ(found.missing, 0u) << "samples without a surface above or below";
                EXPECT_EQ(found.inner_beside, 0u) << "samples that fall between triangles";
                EXPECT_LE(found.max_px, front.error_px() + kSlack_px);
                EXPECT_LE(found.beside_max_px, front.error_px() + kSlack_px);
                EXPECT_LE(front.error_px(), tolerance_px);
                EXPECT_LE(worst_vertex_m(dem, triangles), 1e-3);
            }
        }
    }
}

class TerrainBound : public testing::TestWithParam<Source> {};

TEST_P(TerrainBound, HoldsForEverySampleInView) {
    expect_bound(GetParam(), {kPoses, kTolerances_px, {0}});
}

/// Leaves drawn as patches: every k, at the two ends of the scale.
TEST_P(TerrainBound, HoldsForBatches) {
    constexpr double kBoth_px[] = {1.0, 4.0};
    expect_bound(GetParam(), {std::span(kPoses).first(2), kBoth_px, {1, 2, 3}});
}

INSTANTIATE_TEST_SUITE_P(
    Sources, TerrainBound,
    testing::Values(Source{"jacksboro", "data/samples/jacksboro.tif", data::VoidPolicy::kFill},
                    Source{"bigtujunga", "../shared/data/terrain/srtm_bigtujunga30m_utm11.tif",
                           data::VoidPolicy::kFill},
                    Source{"rainier", "../shared/data/terrain/mt_rainier_90m.tif", data::VoidPolicy::kFill},
                    Source{"monaco_fill", "../shared/data/monaco/N43E007.hgt.zip", data::VoidPolicy::kFill},
                    Source{"monaco_hole", "../shared/data/monaco/N43E007.hgt.zip", data::VoidPolicy::kHole}),
    [](const testing::TestParamInfo<Source>& source) { return std::string(source.param.name); });

/// Straight down from high above, tolerance 0: the source data itself.
TEST(TerrainFullResolution, EveryCellTwoTrianglesEverySampleAVertex) {
    const std::string path = std::string(HARRIER_SOURCE_DIR) + "/data/samples/jacksboro.tif";
    DemTruth dem;
    ASSERT_TRUE(terrain_test::read_truth(path, dem));
    const auto grid = data::read_height_grid({path}, {});
    ASSERT_TRUE(grid) << grid.message();
    terrain::RoamFront front(terrain::make_diamond_table(*grid, 2), {.tolerance_px = 0.0});
    lod::Front* fronts[] = {&front};
    const lod::View view = view_of(dem, {"above", 0.5, 0.5, 60000, 0, -90, 0, 60, 1280, 720});
    front.begin_frame({&view, 1}, 0.0);
    ASSERT_TRUE(lod::schedule(fronts, {.tolerance_px = 0.0}, lod::operation_limit(10'000'000)).converged);
    EXPECT_EQ(front.error_px(), 0.0);
    terrain_test::PoolTwin pool;
    const auto triangles = terrain_test::emit_triangles(front, view, pool);
    EXPECT_EQ(triangles.size(),
              2u * static_cast<size_t>(dem.width - 1) * static_cast<size_t>(dem.height - 1));
    EXPECT_LE(worst_vertex_m(dem, triangles), 1e-3);
    std::vector<bool> is_vertex(dem.height_m.size(), false);
    for (const DrawnTriangle& triangle : triangles) {
        for (const terrain::GridPoint& p : triangle.samples)
            is_vertex[dem.index(p.x, p.y)] = true;
    }
    EXPECT_EQ(std::count(is_vertex.begin(), is_vertex.end(), false), 0);
}

}  // namespace
