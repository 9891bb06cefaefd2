// What is asked about the ground: kinds, normals, batches; on grids over poles, the antimeridian and in UTM.
#include "data/ground_query.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/data/ground_twin.h"
#include "tests/data/relief.h"

namespace {

using data::GroundAnswer;
using data::GroundKind;
using data::HeightGrid;

struct Area {
    const char* name;
    std::array<double, 6> geo_transform;
    const char* crs;
};

class GroundQuery : public testing::TestWithParam<Area> {
  protected:
    HeightGrid grid() const {
        return test::rough_grid(40, 30, GetParam().geo_transform, GetParam().crs, 400.0);
    }
};

/// The same to the bit.
bool is_same(const GroundAnswer& a, const GroundAnswer& b) {
    return a.kind == b.kind && std::memcmp(&a.height_m, &b.height_m, sizeof a.height_m) == 0 &&
           a.normal_world == b.normal_world && a.spacing_m == b.spacing_m;
}

TEST_P(GroundQuery, HeightIsTheSourceTriangles) {
    const HeightGrid ground = grid();
    lod::Rng rng(3);
    for (int i = 0; i < 2000; ++i) {
        const double col = rng.between(-1.0, ground.width), row = rng.between(-1.0, ground.height);
        const test::TwinHeight truth = test::twin_height(ground, col, row);
        const data::SitePoint site = ground.frame.site_from_grid(col, row);
        const GroundAnswer there = data::ground_at_site(ground, site);
        const bool is_near_border =
            std::min({std::abs(col), std::abs(row), std::abs(col - 39), std::abs(row - 29)}) < 1e-6;
        if (is_near_border || std::abs(site.y) > 89.9999) continue;
        ASSERT_EQ(there.is_valid(), truth.is_inside) << col << ' ' << row;
        if (truth.is_inside) {
            ASSERT_NEAR(there.height_m, truth.height_m, 1e-4) << col << ' ' << row;
        }
        const glm::dvec3 world = ground.frame.world_from_grid(col, row, 2500.0);
        const GroundAnswer under = data::ground_under(ground, world);
        ASSERT_EQ(under.is_valid(), truth.is_inside);
        ASSERT_NEAR(under.height_m, there.height_m, 1e-4);
        const data::GroundHeight plain = data::ground_height(ground, site);
        ASSERT_EQ(plain.height_m, there.height_m) << "one way, the same bits";
    }
}

TEST_P(GroundQuery, NormalStandsOnTheTriangle) {
    const HeightGrid ground = grid();
    lod::Rng rng(4);
    for (int i = 0; i < 500; ++i) {
        const glm::dvec2 place(rng.between(0.0, 39.0), rng.between(0.0, 29.0));
        const data::HalfCell half = data::half_cell_at(ground, place.x, place.y);
        const glm::dvec3 normal = data::ground_at_grid(ground, place).normal_world;
        EXPECT_NEAR(glm::length(normal), 1.0, 1e-12);
        const auto world = [&](const glm::ivec2& p) {
            return ground.frame.world_from_grid(p.x, p.y, double{ground.at(p.x, p.y)});
        };
        const glm::dvec3 a = world(half.corner), b = world(half.along_row), c = world(half.along_col);
        const bool is_flat =
            std::abs(ground.frame.site_from_grid(half.corner.x, half.corner.y).y) < 89.9999 &&
            glm::length(glm::cross(b - a, c - a)) > 1.0;
        if (!is_flat) continue;  // upright, or nothing at all, at the pole
        EXPECT_GT(glm::dot(normal, ground.frame.world().world_from_enu(a)[2]), 0.0);
        EXPECT_NEAR(glm::dot(normal, glm::normalize(b - a)), 0.0, 1e-4);
        EXPECT_NEAR(glm::dot(normal, glm::normalize(c - a)), 0.0, 1e-4);
    }
}

TEST_P(GroundQuery, BatchesAreSingleAnswers) {
    const HeightGrid ground = grid();
    lod::Rng rng(5);
    std::vector<data::SitePoint> sites;
    std::vector<glm::dvec3> world;
    for (int i = 0; i < 1111; ++i) {
        const double col = rng.between(-2.0, 41.0), row = rng.between(-2.0, 31.0);
        sites.push_back(ground.frame.site_from_grid(col, row));
        world.push_back(ground.frame.world_from_grid(col, row, rng.between(-100.0, 5000.0)));
    }
    for (unsigned threads : {1u, 2u, 5u}) {
        std::vector<GroundAnswer> at(sites.size()), under(world.size());
        data::ground_at_sites(ground, sites, at, threads);
        data::ground_under(ground, world, under, threads);
        for (size_t i = 0; i < sites.size(); ++i) {
            ASSERT_TRUE(is_same(at[i], data::ground_at_site(ground, sites[i]))) << i;
            ASSERT_TRUE(is_same(under[i], data::ground_under(ground, world[i]))) << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Areas, GroundQuery,
    testing::Values(Area{"planar", test::kPlanarTransform, ""},
                    Area{"degrees", {7.0, 0.001, 0.0, 44.0, 0.0, -0.001}, "EPSG:4326"},
                    Area{"antimeridian", {179.98, 0.001, 0.0, -17.0, 0.0, -0.001}, "EPSG:4326"},
                    Area{"pole", {-180.0, 9.0, 0.0, 90.0005, 0.0, -0.001}, "EPSG:4326"},
                    Area{"utm", {380000.0, 30.0, 0.0, 3800000.0, 0.0, -30.0}, "EPSG:32611"},
                    Area{"polar", {-500.0, 30.0, 0.0, 400.0, 0.0, -30.0}, "EPSG:3995"}),
    [](const auto& one) { return one.param.name; });

TEST(GroundKinds, SayWhatAnAnswerRestsOn) {
    HeightGrid ground = test::rough_grid(10, 8, test::kPlanarTransform, "", 50.0);
    ground.is_void.assign(80, 0);
    ground.is_void[ground.index(4, 3)] = 1;
    int voids = 0;
    lod::Rng rng(6);
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec2 place(rng.between(0.0, 9.0), rng.between(0.0, 7.0));
        const test::TwinHeight truth = test::twin_height(ground, place.x, place.y);
        const GroundAnswer answer = data::ground_at_grid(ground, place);
        ASSERT_EQ(answer.kind, truth.is_void ? GroundKind::kVoid : GroundKind::kMeasured);
        ASSERT_EQ(answer.is_valid(), !truth.is_void);
        ASSERT_NEAR(answer.height_m, truth.height_m, 1e-9);
        ASSERT_EQ(answer.spacing_m, 10.0);
        voids += truth.is_void;
    }
    EXPECT_GT(voids, 50);
    std::swap(ground.is_void, ground.is_filled);
    const GroundAnswer filled = data::ground_at_grid(ground, {4.0, 3.0});
    EXPECT_EQ(filled.kind, GroundKind::kFilled);
    EXPECT_TRUE(filled.is_valid());
    for (const glm::dvec2& place : {glm::dvec2(-1e-9, 0), glm::dvec2(0, 7.0001), glm::dvec2(NAN, 1)}) {
        const GroundAnswer outside = data::ground_at_grid(ground, place);
        EXPECT_EQ(outside.kind, GroundKind::kOutside);
        EXPECT_FALSE(outside.is_valid());
        EXPECT_EQ(outside.height_m, 0.0);
    }
    EXPECT_EQ(data::ground_at_grid(ground, {9.0, 7.0}).kind, GroundKind::kMeasured);
    EXPECT_EQ(data::ground_at_grid(ground, {9.0, 7.0}).height_m, double{ground.at(9, 7)});
}

TEST(GroundKinds, FilledVoidsAreKnownFromTheFile) {
    test::RasterSpec spec{.width = 6, .height = 5, .values = std::vector<double>(30, 100.0)};
    spec.values[2 * 6 + 3] = -9999.0;
    const std::string path = test::write_raster("filled.tif", spec);
    const HeightGrid filled = test::read({path}, {.voids = data::VoidPolicy::kFill});
    EXPECT_FALSE(filled.has_voids());
    EXPECT_EQ(data::ground_at_grid(filled, {3.0, 2.0}).kind, GroundKind::kFilled);
    EXPECT_EQ(data::ground_at_grid(filled, {3.0, 2.0}).height_m, 100.0);
    EXPECT_EQ(data::ground_at_grid(filled, {0.5, 0.5}).kind, GroundKind::kMeasured);
    EXPECT_EQ(data::ground_at_grid(test::read({path}), {3.0, 2.0}).kind, GroundKind::kVoid);
}

}  // namespace
