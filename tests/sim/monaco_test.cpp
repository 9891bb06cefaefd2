// Buildings meet the rendered ground: in converged pictures of a real town on real relief, every foot of every wall,
// as drawn, against the terrain triangle drawn straight above or below it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "sim/scene_file.h"
#include "sim/stage.h"
#include "tests/sim/temp_folder.h"
#include "tests/terrain/dem_truth.h"
#include "tests/terrain/picture_point.h"
#include "tests/terrain/vertical_probe.h"

namespace {

using terrain_test::is_in_picture;
using terrain_test::projected;
using terrain_test::radians;

struct Foot {
    glm::dvec3 world, up;
    double col, row;
};

glm::dvec3 vec_of(const float v[4]) {
    return {double(v[0]), double(v[1]), double(v[2])};
}

/// Place of a world position in the raster, and the vertical there, by GeographicLib.
Foot foot_at(const glm::dvec3& world, const terrain_test::DemTruth& dem) {
    double lat = 0.0, lon = 0.0, height = 0.0;
    std::vector<double> m(9);
    GeographicLib::Geocentric::WGS84().Reverse(world.x, world.y, world.z, lat, lon, height, m);
    return {world,
            {m[2], m[5], m[8]},
            (lon - dem.geo[0]) / dem.geo[1] - 0.5,
            (lat - dem.geo[3]) / dem.geo[5] - 0.5};
}

/// Feet of walls where the vertex shader puts them: sunk along the vertical by the ground's error, which up_eye.w
/// gives in pixels.
std::vector<Foot> feet_in_view(const sim::Stage& stage, const terrain_test::PoolTwin& pool,
                               const lod::View& view, const terrain_test::DemTruth& dem) {
    const double lambda_px = view.height_px / (2.0 * std::tan(view.fov_y_rad / 2.0));
    std::set<uint32_t> seen;
    std::vector<Foot> feet;
    for (const lod::DrawItem& item : stage.list.items) {
        const lod::Instance& instance = stage.list.instances[item.instance];
        if (instance.module != static_cast<uint32_t>(lod::Module::kObjects)) continue;
        for (uint32_t i = 0; i < item.index_count; ++i) {
            const auto index =
                static_cast<uint32_t>(int64_t{pool.indices[item.first_index + i]} + item.base_vertex);
            const lod::Vertex& vertex = pool.vertices[index];
            if (vertex.colour[3] != static_cast<uint8_t>(lod::Material::kWallFoot) ||
                !seen.insert(index).second)
                continue;
            const glm::dvec3 source = lod::position_of(vertex);
            const double lowered_m = double(instance.up_eye[3]) * projected(view, source).z / lambda_px;
            const glm::dvec3 up = glm::transpose(view.eye_from_world) * vec_of(instance.up_eye);
            const glm::dvec3 drawn = source - up * lowered_m;
            if (is_in_picture(view, projected(view, drawn))) feet.push_back(foot_at(drawn, dem));
        }
    }
    return feet;
}

struct Gaps {
    std::vector<double> px;  ///< above the drawn ground; negative: below it
    std::vector<double> m;
    size_t without_ground = 0;
};

Gaps measure(const std::vector<Foot>& feet, const terrain_test::VerticalProbe& probe, const lod::View& view) {
    Gaps gaps;
    for (const Foot& foot : feet) {
        const auto hit = probe.probe(static_cast<int>(std::lround(foot.col)),
                                     static_cast<int>(std::lround(foot.row)), foot.world, foot.up);
        if (!hit.found || hit.beside_m > 0.0) {
            ++gaps.without_ground;
            continue;
        }
        const glm::dvec3 a = projected(view, foot.world),
                         b = projected(view, foot.world + foot.up * hit.above_m);
        const double px = std::hypot(a.x - b.x, a.y - b.y);
        gaps.px.push_back(hit.above_m < 0.0 ? px : -px);
        gaps.m.push_back(-hit.above_m);
    }
    std::sort(gaps.px.begin(), gaps.px.end());
    std::sort(gaps.m.begin(), gaps.m.end());
    return gaps;
}

double quantile(const std::vector<double>& sorted, double share) {
    return sorted[static_cast<size_t>(share * static_cast<double>(sorted.size() - 1))];
}

constexpr const char* kSceneText = R"(name = "Monaco"
[terrain]
sources = ["DATA/N43E007.hgt.zip"]
[[buildings]]
source = "DATA/monaco-2021.osm.pbf"
default_height_m = 8.0
)";

constexpr double kViews[][5] = {
    // longitude, latitude, height, heading, pitch
    {7.4350, 43.7300, 120.0, 315.0, -5.0}, {7.4150, 43.7220, 300.0, 20.0, -12.0},
    {7.4246, 43.7370, 800.0, 0.0, -80.0},  {7.4400, 43.7500, 450.0, 225.0, -20.0},
    {7.4130, 43.7310, 200.0, 45.0, -15.0},
};

TEST(Monaco, WallsMeetTheRenderedGround) {
    const std::string data = std::string(HARRIER_SOURCE_DIR) + "/../shared/data/monaco";
    if (!std::ifstream(data + "/N43E007.hgt.zip")) GTEST_SKIP() << data << " is not on this machine";
    std::string text = kSceneText;
    for (size_t at = text.find("DATA"); at != std::string::npos; at = text.find("DATA"))
        text.replace(at, 4, data);
    const sim_test::TempFolder folder;
    const auto scene = sim::read_scene(folder.write("monaco.toml", text));
    ASSERT_TRUE(scene) << scene.message();
    sim::WorldOptions building;
    building.has_picture = false;
    auto world = sim::build_world(*scene, building);
    ASSERT_TRUE(world) << world.message();
    ASSERT_GT((*world)->buildings.size(), 1000u);
    terrain_test::DemTruth dem;
    ASSERT_TRUE(terrain_test::read_truth(data + "/N43E007.hgt.zip", dem));
    sim::Optics optics;
    optics.width_px = 1280;
    optics.height_px = 720;
    auto stage = sim::make_stage(std::move(*world), optics, {});
    if (!stage) GTEST_SKIP() << stage.message();

    terrain_test::PoolTwin pool;
    sim::Allowance allowance;
    allowance.budget.tolerance_px = 1.0;
    allowance.deadline = lod::operation_limit(100'000'000);
    for (const auto& pose : kViews) {
        sim::Shot shot;
        shot.state = {{pose[0], pose[1], pose[2]}, radians(pose[3]), radians(pose[4]), 0.0};
        const auto frame = sim::make_frame(*stage, shot, allowance);
        ASSERT_TRUE(frame) << frame.message();
        ASSERT_TRUE(frame->converged);
        const lod::View view = sim::view_of(*stage->world, optics, shot.state, shot.head);
        pool.apply(stage->list);
        const auto ground = terrain_test::drawn_triangles(pool, stage->list, lod::Module::kTerrain);
        const terrain_test::VerticalProbe probe(dem.width, dem.height, 90.0, ground);
        const Gaps gaps = measure(feet_in_view(*stage, pool, view, dem), probe, view);
        ASSERT_GT(gaps.px.size(), 500u) << "the view should see the town";
        std::printf(
            "eye at %.4f, %.4f, %3.0f m: %zu feet; above the ground by p99 %.2f, max %.2f px (%.2f m); below "
            "it "
            "by p50 %.2f, p99 %.2f, max %.2f px (%.2f m); bound %.2f px\n",
            pose[0], pose[1], pose[2], gaps.px.size(), quantile(gaps.px, 0.99), gaps.px.back(), gaps.m.back(),
            -quantile(gaps.px, 0.5), -quantile(gaps.px, 0.01), -gaps.px.front(), -gaps.m.front(),
            frame->error_px[0]);
        EXPECT_EQ(gaps.without_ground, 0u);
        EXPECT_LE(gaps.px.back(), 0.5 * frame->error_px[0]) << "a foot floats";
        EXPECT_LE(quantile(gaps.px, 0.99), 1.0) << "feet float";
        // Lowered by half the bound, at most the bound below the source ground already.
        EXPECT_GE(gaps.px.front(), -1.5 * frame->error_px[0]);
        EXPECT_GE(quantile(gaps.px, 0.01), -1.0) << "feet are sunk deeper than they need be";
    }
}

}  // namespace
