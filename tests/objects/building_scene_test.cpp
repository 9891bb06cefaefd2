#include "objects/building_scene.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>

#include "data/ground_height.h"
#include "data/object_plan.h"
#include "data/scene_time.h"

namespace objects {
namespace {

std::string shared_data(const std::string& name) {
    return HARRIER_SOURCE_DIR "/../shared/data/" + name;
}

/// What another program prints; empty where it is not there.
std::string output_of(const std::string& command) {
    std::string text;
    if (FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r")) {
        for (int letter = std::fgetc(pipe); letter != EOF; letter = std::fgetc(pipe))
            text += static_cast<char>(letter);
        pclose(pipe);
    }
    return text;
}

TEST(BuildingScene, MonacosBuildingsAreObjectsByTheirIds) {
    const std::string path = shared_data("monaco/monaco-2021.osm.pbf");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    const auto footprints = data::read_footprints(path, {}, {});
    ASSERT_TRUE(footprints);
    const auto scene = read_timed_scene(path, {});
    ASSERT_TRUE(scene) << scene.message();
    const auto sound = data::check_timed_scene(*scene);
    ASSERT_TRUE(sound) << sound.message();
    std::set<int64_t> ids;
    for (const data::Footprint& footprint : footprints->buildings)
        ids.insert(footprint.id);
    EXPECT_NEAR(static_cast<double>(scene->objects.size()), static_cast<double>(ids.size()), 3.0);
    EXPECT_TRUE(scene->is_on_earth);
    EXPECT_NEAR(scene->origin_site.x, 7.42, 0.02);
    EXPECT_NEAR(scene->origin_site.y, 43.73, 0.02);
    EXPECT_EQ(data::count_classes(*scene).objects[0], scene->objects.size())
        << "without a schedule all is static";
}

/// ogrinfo counts the features of the shapefile.
TEST(BuildingScene, AShapefileHasWhatOgrinfoCounts) {
    const std::string path = shared_data("somerset/buildings.shp");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    const std::string told = output_of("ogrinfo -so -al " + path);
    const size_t at = told.find("Feature Count: ");
    if (at == std::string::npos) GTEST_SKIP() << "no ogrinfo";
    const auto scene = read_timed_scene(path, {});
    ASSERT_TRUE(scene) << scene.message();
    EXPECT_EQ(scene->objects.size(), std::stoul(told.substr(at + 15)));
    ASSERT_TRUE(data::check_timed_scene(*scene));
}

/// Normals are those of the faces, walls stand on the plane z = 0 up to the Earth's curve.
TEST(BuildingScene, WallsStandOnTheGround) {
    const std::string path = shared_data("city/nyc.osm.pbf");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    const auto scene = read_timed_scene(path, {});
    ASSERT_TRUE(scene) << scene.message();
    ASSERT_GT(scene->objects.size(), 1400u);
    for (const data::TimedObject& object : scene->objects) {
        const glm::dvec3 base = data::keys_of(*scene, object)[0].position;
        const data::TimedMesh& mesh = scene->meshes[object.mesh];
        const double fall_m = (base.x * base.x + base.y * base.y) / 2.0 / 6371000.0;
        EXPECT_NEAR(base.z, -fall_m, 0.02 + 0.01 * fall_m);
        for (const auto& triangle : mesh.triangles) {
            const glm::vec3 normal = glm::cross(mesh.positions[triangle[1]] - mesh.positions[triangle[0]],
                                                mesh.positions[triangle[2]] - mesh.positions[triangle[0]]);
            ASSERT_GE(glm::dot(normal, mesh.normals[triangle[0]]), 0.0f) << object.id;
        }
    }
}

/// On terrain every building's base lies on the source ground, whatever the scene frame is.
TEST(BuildingScene, BuildingsStandOnTheTerrain) {
    const std::string path = shared_data("monaco/monaco-2021.osm.pbf"),
                      relief = shared_data("monaco/N43E007.hgt.zip");
    if (!std::filesystem::exists(relief)) GTEST_SKIP() << relief << " is not there";
    const auto grid = data::read_height_grid({relief}, {});
    ASSERT_TRUE(grid) << grid.message();
    const auto scene = read_timed_scene(path, {}, {.world = {}, .grid = &*grid});
    ASSERT_TRUE(scene) << scene.message();
    EXPECT_GT(scene->objects.size(), 1000u);
    const data::WorldFrame world;
    const glm::dvec3& origin = scene->origin_site;
    const glm::dvec3 origin_world = world.world_from_site({origin.x, origin.y, origin.z});
    const glm::dmat3 world_from_enu = world.world_from_enu(origin_world);
    double lowest_m = 1e9, highest_m = -1e9;
    for (const data::TimedObject& object : scene->objects) {
        const glm::dvec3 base = data::keys_of(*scene, object)[0].position;
        const data::SitePoint site = world.site_from_world(origin_world + world_from_enu * base);
        EXPECT_NEAR(site.height_m, data::ground_height(*grid, site).height_m, 0.01) << object.id;
        lowest_m = std::min(lowest_m, site.height_m);
        highest_m = std::max(highest_m, site.height_m);
    }
    EXPECT_GT(highest_m - lowest_m, 50.0) << "Monaco is steep";
}

TEST(BuildingScene, AScheduleOfACityNamesItsBuildings) {
    const std::string path = shared_data("monaco/monaco-2021.osm.pbf");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    const auto plain = read_timed_scene(path, {});
    ASSERT_TRUE(plain);
    const auto folder = std::filesystem::temp_directory_path() / ("harrier_city_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    const std::string schedule = (folder / "when.csv").string();
    std::ofstream(schedule) << "id,appears_s,disappears_s,time_s,x_m,y_m,z_m,model\n,,100\n"
                            << plain->objects[5].id << ",10,\n"
                            << "crane,,,0,0,0,0," << shared_data("city/tracked_crane.glb")
                            << "\ncrane,,,50,30,0,0\n";
    const auto scene = read_timed_scene(path, {.schedule = schedule});
    std::filesystem::remove_all(folder);
    ASSERT_TRUE(scene) << scene.message();
    const data::ClassCounts counts = data::count_classes(*scene);
    EXPECT_EQ(counts.objects[1], 1u);
    EXPECT_EQ(counts.objects[2], 1u);
    EXPECT_EQ(counts.objects[0], plain->objects.size() - 1);
    EXPECT_FALSE(data::is_visible(*scene, scene->objects[5], 9.0));
    EXPECT_TRUE(data::is_visible(*scene, scene->objects[5], 11.0));
}

TEST(BuildingScene, ModelsAndMissingFilesGoToTheirReaders) {
    EXPECT_FALSE(read_timed_scene("/nowhere/missing.osm.pbf", {}));
    EXPECT_FALSE(read_timed_scene("/nowhere/missing.json", {}));
    EXPECT_FALSE(read_timed_scene("/nowhere/missing.glb", {}));
}

}  // namespace
}  // namespace objects
