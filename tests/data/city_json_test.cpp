#include "data/city_json.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "data/timed_scene_file.h"
#include "tests/data/timed_folder.h"

namespace data {
namespace {

class CityJson : public TimedFolder {};

double area_m2(const TimedMesh& mesh) {
    double area = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::dvec3 p(mesh.positions[a]), q(mesh.positions[b]), r(mesh.positions[c]);
        area += glm::length(glm::cross(q - p, r - p)) / 2.0;
    }
    return area;
}

/// The file itself, without any reader of ours.
class Delft : public ::testing::Test {
  protected:
    void SetUp() override {
        std::ifstream file(path_);
        if (!file) GTEST_SKIP() << path_ << " is not there";
        root_ = nlohmann::json::parse(file);
        const auto& t = root_["transform"];
        for (const auto& v : root_["vertices"]) {
            glm::dvec3 point;
            for (size_t i = 0; i < 3; ++i)
                point[static_cast<int>(i)] =
                    v[i].get<double>() * t["scale"][i].get<double>() + t["translate"][i].get<double>();
            points_.push_back(point);
        }
    }
    /// Area of a surface: of its outer ring less the holes, each by Newell.
    double area_of(const nlohmann::json& surface) const {
        double area = 0.0;
        for (size_t r = 0; r < surface.size(); ++r) {
            glm::dvec3 sum(0.0);
            const auto at = [&](size_t i) {
                return points_[surface[r][i % surface[r].size()].get<size_t>()] -
                       points_[surface[r][0].get<size_t>()];
            };
            for (size_t i = 0; i < surface[r].size(); ++i)
                sum += glm::cross(at(i), at(i + 1));
            area += (r == 0 ? 0.5 : -0.5) * glm::length(sum);
        }
        return area;
    }
    const std::string path_ = shared_data("city/delft.json");
    nlohmann::json root_;
    std::vector<glm::dvec3> points_;
};

TEST_F(Delft, HasEveryObjectWithItsArea) {
    CityJsonStats stats;
    const auto scene = read_city_json(path_, &stats);
    ASSERT_TRUE(scene) << scene.message();
    EXPECT_EQ(scene->objects.size() + stats.without_geometry, root_["CityObjects"].size());
    EXPECT_EQ(scene->objects.size(), 570u);
    double ours_m2 = 0.0, file_m2 = 0.0;
    size_t worse = 0;
    for (const SourceObject& object : scene->objects) {
        const auto& geometry = root_["CityObjects"][object.id]["geometry"][0];
        const bool is_solid = geometry["type"] == "Solid";
        double expected_m2 = 0.0;
        for (const auto& surface : is_solid ? geometry["boundaries"][0] : geometry["boundaries"])
            expected_m2 += area_of(surface);
        const double area = area_m2(scene->meshes[object.mesh]);
        worse += std::abs(area - expected_m2) > 2e-3 * expected_m2 + 0.01 ? 1u : 0u;
        ours_m2 += area;
        file_m2 += expected_m2;
    }
    EXPECT_LT(stats.not_triangulated, 10u);
    EXPECT_LE(worse, stats.not_triangulated);
    EXPECT_NEAR(ours_m2, file_m2, 1e-3 * file_m2);
}

/// PROJ by way of another program: where the middle of the data is, and how far a corner lies from it.
TEST_F(Delft, StandsWhereGdalSays) {
    const auto scene = read_city_json(path_);
    ASSERT_TRUE(scene) << scene.message();
    EXPECT_TRUE(scene->is_on_earth);
    glm::dvec3 low = points_[0], high = points_[0];
    for (const glm::dvec3& point : points_) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    char command[256];
    std::snprintf(command, sizeof command,
                  "echo %.6f %.6f | gdaltransform -s_srs EPSG:28992 -t_srs EPSG:4326 -output_xy",
                  (low.x + high.x) / 2.0, (low.y + high.y) / 2.0);
    FILE* pipe = popen(command, "r");
    ASSERT_NE(pipe, nullptr);
    double lon = 0.0, lat = 0.0;
    const int read = std::fscanf(pipe, "%lf %lf", &lon, &lat);
    pclose(pipe);
    if (read != 2) GTEST_SKIP() << "no gdaltransform";
    EXPECT_NEAR(scene->origin_site.x, lon, 1e-6);
    EXPECT_NEAR(scene->origin_site.y, lat, 1e-6);
    EXPECT_NEAR(scene->origin_site.z, low.z, 1e-9);
    const double size_m = glm::distance(glm::dvec2(low), glm::dvec2(high));
    glm::dvec3 least(1e9), most(-1e9);
    for (const SourceObject& object : scene->objects) {
        for (const glm::vec3& position : scene->meshes[object.mesh].positions) {
            least = glm::min(least, object.keys[0].position + glm::dvec3(position));
            most = glm::max(most, object.keys[0].position + glm::dvec3(position));
        }
    }
    EXPECT_NEAR(glm::distance(glm::dvec2(least), glm::dvec2(most)), size_m, 0.03 * size_m)
        << "grid north is not north";
    EXPECT_NEAR(most.z, high.z - low.z, 0.05) << "the Earth falls away by 2 cm at 500 m";
}

TEST_F(Delft, AScheduleMakesItFourDimensional) {
    const auto folder =
        std::filesystem::temp_directory_path() / ("harrier_delft_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    const std::string schedule = (folder / "when.csv").string();
    const std::string building = [&] {
        for (const auto& [id, object] : root_["CityObjects"].items()) {
            if (object["type"] == "Building") return id;
        }
        return std::string();
    }();
    std::ofstream(schedule) << "id,appears_s,disappears_s,time_s,x_m,y_m,z_m,heading_deg,model\n,,300\n"
                            << building << ",100,200\n"
                            << "crane,0,,10,0,0,0,0," << shared_data("city/tower_crane.glb") << "\n"
                            << "crane,,,90,40,0,0,90\n";
    const auto scene = read_timed_scene(path_, {.schedule = schedule});
    std::filesystem::remove_all(folder);
    ASSERT_TRUE(scene) << scene.message();
    const ClassCounts counts = count_classes(*scene);
    EXPECT_EQ(counts.objects, (std::array<uint64_t, 3>{569, 1, 1}));
    EXPECT_GT(counts.triangles[2], 1000u);
    EXPECT_EQ(scene->end_s, 300.0);
}

TEST_F(CityJson, SmallFilesByHand) {
    const std::string head =
        R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.5,0.5,0.5],"translate":[100,200,10]},)";
    const std::string square =
        R"("vertices":[[0,0,0],[4,0,0],[4,4,0],[0,4,0],[1,1,0],[3,1,0],[3,3,0],[1,3,0]],)";
    const auto read = [&](const std::string& text) { return read_city_json(write("small.json", text)); };
    const auto good = read(
        head + square +
        R"("CityObjects":{"a":{"type":"Road","geometry":[{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2,3],[4,7,6,5]]]},
                              {"type":"MultiSurface","lod":"0","boundaries":[[[0,1,2]]]}]},"b":{"type":"Building"}}})");
    ASSERT_TRUE(good) << good.message();
    ASSERT_EQ(good->objects.size(), 1u);
    EXPECT_FALSE(good->is_on_earth);
    EXPECT_EQ(good->origin_site, glm::dvec3(101.0, 201.0, 10.0));
    EXPECT_EQ(good->objects[0].keys[0].position, glm::dvec3(-1.0, -1.0, 0.0));
    EXPECT_NEAR(area_m2(good->meshes[0]), 3.0, 1e-6) << "2 m square with a hole of 1 m";
    const auto refused = [&](const std::string& text, const std::string& why) {
        const auto scene = read(text);
        EXPECT_FALSE(scene) << text;
        EXPECT_NE((scene ? "" : scene.message()).find(why), std::string::npos)
            << (scene ? "" : scene.message());
    };
    refused("", "no whole JSON");
    refused(head, "no whole JSON");
    refused(R"({"type":"FeatureCollection"})", "no CityJSON");
    refused(head + R"("CityObjects":{}})", "vertices");
    refused(head + R"("vertices":[[0,0]]})", "vertex 0");
    refused(head + R"("vertices":[[0,0,"x"]]})", "vertex 0");
    refused(head + R"("vertices":[]})", "CityObjects");
    refused(head + square +
                R"("CityObjects":{"a":{"geometry":[{"type":"MultiSurface","boundaries":[[[0,1,9]]]}]}}})",
            "'a'");
    refused(
        head + square + R"("CityObjects":{"a":{"geometry":[{"type":"Solid","boundaries":[[[0,1,2]]]}]}}})",
        "'a'");
    refused(
        head + square +
            R"("metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/999999"},"CityObjects":{}})",
        "999999");
}

}  // namespace
}  // namespace data
