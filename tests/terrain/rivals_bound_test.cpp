// The rivals' promise: no sample in view is farther from the drawn surface than error_px says. Judged from outside:
// every sample is projected, and so is the drawn surface straight above or below it.
#include <gtest/gtest.h>

#include <limits>

#include "tests/terrain/dem_truth.h"
#include "tests/terrain/rival_rig.h"
#include "tests/terrain/vertical_probe.h"

namespace {

using terrain::Rival;
using terrain_test::DrawnTriangle;
using terrain_test::RivalRelief;

constexpr double kTolerances_px[] = {0.5, 1.0, 2.0, 4.0};

struct Sample {
    int col, row;
    glm::dvec3 world, up;
};

/// All samples of a relief and how far apart they are.
struct Truth {
    int width = 0, height = 0;
    double cell_m = 0.0;
    std::vector<Sample> samples;
};

Truth truth_of(const RivalRelief& relief) {
    Truth truth{relief.grid.width, relief.grid.height, relief.spacing_m, {}};
    for (int row = 0; row < truth.height; ++row) {
        for (int col = 0; col < truth.width; ++col) {
            const glm::dvec3 world(col * relief.spacing_m, (truth.height - 1 - row) * relief.spacing_m,
                                   double(relief.grid.at(col, row)));
            truth.samples.push_back({col, row, world, {0.0, 0.0, 1.0}});
        }
    }
    return truth;
}

Truth truth_of(const terrain_test::DemTruth& dem) {
    Truth truth{dem.width, dem.height, glm::distance(dem.ground(0, 0).base, dem.ground(0, 1).base), {}};
    for (int row = 0; row < truth.height; ++row) {
        for (int col = 0; col < truth.width; ++col) {
            const terrain_test::TrueGround at = dem.ground(col, row);
            truth.samples.push_back({col, row, at.base + at.up * dem.height_m[dem.index(col, row)], at.up});
        }
    }
    return truth;
}

/// Pixels from the picture's centre; z: depth in metres.
glm::dvec3 projected(const lod::View& view, const glm::dvec3& world) {
    const glm::dvec3 eye = view.eye_from_world * (world - view.eye_world);
    const double scale = view.height_px / (2.0 * std::tan(view.fov_y_rad / 2.0)) / -eye.z;
    return {eye.x * scale, eye.y * scale, -eye.z};
}

struct Findings {
    double max_px = 0.0, beside_px = 0.0;
    size_t seen = 0, missing = 0;
};

Findings measure(const Truth& truth, const lod::View& view, const std::vector<DrawnTriangle>& triangles) {
    const terrain_test::VerticalProbe probe(truth.width, truth.height, truth.cell_m, triangles);
    Findings found;
    for (const Sample& sample : truth.samples) {
        const glm::dvec3 at = projected(view, sample.world);
        const bool is_seen = at.z > view.near_m && std::abs(at.x) < view.width_px / 2.0 &&
                             std::abs(at.y) < view.height_px / 2.0;
        if (!is_seen) continue;
        ++found.seen;
        const auto hit = probe.probe(sample.col, sample.row, sample.world, sample.up);
        if (!hit.found) {
            ++found.missing;
            continue;
        }
        const double lambda_px = view.height_px / (2.0 * std::tan(view.fov_y_rad / 2.0));
        found.beside_px = std::max(found.beside_px, lambda_px * hit.beside_m / at.z);
        const glm::dvec3 drawn = projected(view, sample.world + sample.up * hit.above_m);
        found.max_px = std::max(found.max_px, drawn.z > 0.0 ? std::hypot(drawn.x - at.x, drawn.y - at.y)
                                                            : std::numeric_limits<double>::infinity());
    }
    return found;
}

/// How sharp the bounds were.
struct Sharpness {
    double sum = 0.0;
    int count = 0;
};

void check(terrain::RivalFront& front, const lod::View& view, double tolerance_px, const Truth& truth,
           Sharpness& sharpness) {
    ASSERT_TRUE(terrain_test::converge(front, view, tolerance_px));
    terrain_test::PoolTwin pool;
    const auto ground = terrain_test::without_skirts(terrain_test::emit_triangles(front, view, pool));
    const Findings found = measure(truth, view, ground);
    EXPECT_EQ(found.missing, 0u);
    EXPECT_LE(found.max_px, front.error_px() + 0.01);
    EXPECT_LE(found.beside_px, front.error_px() + 0.01);
    EXPECT_LE(front.error_px(), tolerance_px);
    if (found.seen < 100) return;
    sharpness.sum += found.max_px / tolerance_px;
    ++sharpness.count;
}

class RivalBound : public testing::TestWithParam<Rival> {};

TEST_P(RivalBound, HoldsOverFractalRelief) {
    Sharpness sharpness;
    for (const auto& [width, height, cells] : {std::tuple{129, 129, 16}, {200, 131, 32}}) {
        const RivalRelief relief(width, height, 8.0, 300.0, 1);
        const Truth truth = truth_of(relief);
        lod::Rng rng(2);
        const auto front = relief.front(GetParam(), 1.0, cells);
        for (int i = 0; i < 8; ++i) {
            lod::View view = relief.random_view(rng);
            view.fov_y_rad = rng.between(0.3, 1.9);
            for (const double tolerance_px : kTolerances_px) {
                SCOPED_TRACE("view " + std::to_string(i) + ", " + std::to_string(tolerance_px) + " px");
                check(*front, view, tolerance_px, truth, sharpness);
            }
        }
    }
    ASSERT_GT(sharpness.count, 20);
    std::printf("%s: measured / tolerance %.2f on average\n", terrain_test::name_of(GetParam()).c_str(),
                sharpness.sum / sharpness.count);
}

TEST_P(RivalBound, HoldsOverRealRelief) {
    const std::string path = std::string(HARRIER_SOURCE_DIR) + "/data/samples/jacksboro.tif";
    terrain_test::DemTruth dem;
    ASSERT_TRUE(terrain_test::read_truth(path, dem));
    const auto grid = data::read_height_grid({path}, {});
    ASSERT_TRUE(grid) << grid.message();
    const Truth truth = truth_of(dem);
    const auto front = terrain::make_rival(GetParam(), *grid, terrain::make_diamond_table(*grid, 2), {});
    Sharpness sharpness;
    lod::Rng rng(3);
    for (int i = 0; i < 3; ++i) {
        const Sample& at = truth.samples[rng.below(truth.samples.size())];
        const glm::dvec3 east = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), at.up));
        lod::View view;
        view.eye_world = at.world + at.up * rng.between(100.0, 3000.0);
        view.eye_from_world = lod::eye_from_attitude(glm::dmat3(east, glm::cross(at.up, east), at.up),
                                                     rng.between(0.0, 6.3), rng.between(-1.5, 0.0), 0.1);
        view.width_px = 1280;
        view.height_px = 720;
        for (const double tolerance_px : kTolerances_px) {
            SCOPED_TRACE("view " + std::to_string(i) + ", " + std::to_string(tolerance_px) + " px");
            check(*front, view, tolerance_px, truth, sharpness);
        }
    }
}

/// A strip that gives way to a coarser neighbour loses more than either block does alone: the border's chord lies too
/// high and the sample beside it too low. That, too, must be counted.
TEST(GeoMipmapBound, CountsWhatStitchingAdds) {
    constexpr float kRise_m = 0.9f, kDip_m = 0.9f;
    std::vector<float> heights(17 * 9, 0.0f);
    const auto at = [&](int col, int row) -> float& { return heights[static_cast<size_t>(row * 17 + col)]; };
    at(8, 0) = at(8, 8) = kRise_m;  // the ends of the common border
    at(9, 4) = -kDip_m;             // beside it, in the east block
    for (int row = 3; row <= 5;
         ++row) {  // a pyramid that every other sample describes, and every fourth does not
        for (int col = 11; col <= 13; ++col)
            at(col, row) = 2.5f;
    }
    at(12, 4) = 5.0f;
    const auto grid = data::make_planar_grid(17, 9, 10.0, std::move(heights));
    const lod::View view = terrain_test::level_view({85.0, -4000.0, 0.0}, 0.0, 0.0);
    const double px_per_m = 720.0 / (2.0 * std::tan(view.fov_y_rad / 2.0)) / 4000.0;
    Truth truth{17, 9, 10.0, {}};
    for (int i = 0; i < 17 * 9; ++i) {
        const glm::dvec3 world(i % 17 * 10.0, (8 - i / 17) * 10.0, double(grid.at(i % 17, i / 17)));
        truth.samples.push_back({i % 17, i / 17, world, {0.0, 0.0, 1.0}});
    }
    for (const double tolerance_m : {0.5, 0.8, 1.0, 1.2, 1.4, 2.0}) {
        SCOPED_TRACE(tolerance_m);
        const auto front = terrain::make_rival(Rival::kGeoMipmap, grid, terrain::make_diamond_table(grid, 1),
                                               {.block_cells = 8});
        Sharpness sharpness;
        check(*front, view, tolerance_m * px_per_m, truth, sharpness);
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, RivalBound,
                         testing::Values(Rival::kChunkedQuadtree, Rival::kGeoMipmap, Rival::kVipmBlocks,
                                         Rival::kVdpm, Rival::kRoamMergeOnly),
                         [](const testing::TestParamInfo<Rival>& kind) {
                             return terrain_test::name_of(kind.param);
                         });

}  // namespace
