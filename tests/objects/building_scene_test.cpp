#include "objects/building_scene.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>

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
