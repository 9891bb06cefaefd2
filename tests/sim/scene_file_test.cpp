// Scene files: everything the contract names is read; everything else is refused with file and line.
#include "sim/scene_file.h"

#include <gtest/gtest.h>

#include <numbers>

#include "sim/signals.h"
#include "tests/sim/temp_folder.h"

namespace {

using sim_test::TempFolder;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

const char* const kFull = R"(name = "Monaco"
[terrain]
sources = ["N43E007.hgt.zip", "sub/b.tif"]
imagery = ["/abs/ortho.tif"]
voids   = "hole"
[[buildings]]
source  = "monaco.osm.pbf"
default_height_m = 9
[[buildings]]
source  = "more.gpkg"
[[models]]
source  = "crane.glb"
position = [7.42, 43.73]
height_m = 1.5
heading_deg = 90.0
scale   = 2.0
drives  = { needle_60 = "time_s" }
[[instruments]]
source  = "altimeter.glb"
position_m = [0.0, -0.25, -0.6]
drives  = { needle_1000 = "altitude_m", card_360 = "heading_deg" }
[start]
camera  = [7.40, 43.70, 800.0, 45.0, -5.0, 1]
fov_deg = 50.0
time_s  = 3.0
[path]
kind = "drive"
waypoints = [[7.40, 43.70], [7.45, 43.75, 600.0]]
speed_mps = 100.0
[time]
begin_s = 1.0
end_s   = 600.0
)";

TEST(SceneFile, ReadsEverythingTheContractNames) {
    const TempFolder folder;
    const auto scene = sim::read_scene(folder.write("a.toml", kFull));
    ASSERT_TRUE(scene) << scene.message();
    EXPECT_EQ(scene->name, "Monaco");
    ASSERT_TRUE(scene->terrain);
    EXPECT_EQ(scene->terrain->sources,
              (std::vector{folder.file("N43E007.hgt.zip"), folder.file("sub/b.tif")}));
    EXPECT_EQ(scene->terrain->imagery, (std::vector<std::string>{"/abs/ortho.tif"}));
    EXPECT_EQ(scene->terrain->voids, data::VoidPolicy::kHole);
    ASSERT_EQ(scene->buildings.size(), 2u);
    EXPECT_EQ(scene->buildings[0].default_height_m, 9.0);
    EXPECT_EQ(scene->buildings[1].default_height_m, 8.0);
    ASSERT_EQ(scene->models.size(), 1u);
    EXPECT_EQ(scene->models[0].site, glm::dvec2(7.42, 43.73));
    EXPECT_DOUBLE_EQ(scene->models[0].heading_rad, std::numbers::pi / 2);
    ASSERT_EQ(scene->models[0].drives.size(), 1u);
    EXPECT_EQ(scene->models[0].drives[0].node, "needle_60");
    ASSERT_EQ(scene->instruments.size(), 1u);
    const auto& drives = scene->instruments[0].drives;
    ASSERT_EQ(drives.size(), 2u);
    EXPECT_EQ(drives[0].node, "card_360");
    EXPECT_EQ(drives[0].signal, sim::signal_index("heading_deg"));
    EXPECT_EQ(drives[1].node, "needle_1000");
    EXPECT_EQ(scene->start.site.height_m, 800.0);
    EXPECT_DOUBLE_EQ(scene->start.pitch_rad, -5.0 * kRadPerDeg);
    EXPECT_DOUBLE_EQ(scene->start.fov_y_rad, 50.0 * kRadPerDeg);
    EXPECT_EQ(scene->start.time_s, 3.0);
    ASSERT_TRUE(scene->path);
    EXPECT_EQ(scene->path->kind, sim::PathSource::Kind::kDrive);
    ASSERT_EQ(scene->path->waypoints.size(), 2u);
    EXPECT_EQ(scene->path->waypoints[1].height_m, 600.0);
    EXPECT_EQ(scene->time.end_s, 600.0);
}

TEST(SceneFile, AbsentTablesStayAbsent) {
    const TempFolder folder;
    const auto scene = sim::read_scene(folder.write("plain.toml", "[time]\nbegin_s = 0\n"));
    ASSERT_TRUE(scene) << scene.message();
    EXPECT_EQ(scene->name, "plain");
    EXPECT_FALSE(scene->terrain);
    EXPECT_FALSE(scene->path);
    EXPECT_FALSE(scene->start.is_given);
    EXPECT_FALSE(scene->time.end_s);
}

TEST(SceneFile, PathWithSourceIsARecording) {
    const TempFolder folder;
    const auto scene = sim::read_scene(folder.write("r.toml", "[path]\nsource = \"nice.csv\"\n"));
    ASSERT_TRUE(scene) << scene.message();
    EXPECT_EQ(scene->path->kind, sim::PathSource::Kind::kRecorded);
    EXPECT_EQ(scene->path->source, folder.file("nice.csv"));
}

struct BadScene {
    const char* name;
    const char* text;
    int line;
    const char* must_say;
};

class SceneFileRefuses : public testing::TestWithParam<BadScene> {};

TEST_P(SceneFileRefuses, WithFileLineAndExpectation) {
    const TempFolder folder;
    const std::string file = folder.write("bad.toml", GetParam().text);
    const auto scene = sim::read_scene(file);
    ASSERT_FALSE(scene);
    const std::string& message = scene.message();
    EXPECT_EQ(message.find(file + ":" + std::to_string(GetParam().line) + ": "), 0u) << message;
    EXPECT_NE(message.find(GetParam().must_say), std::string::npos) << message;
    EXPECT_NE(message.find("expected"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

const BadScene kBadScenes[] = {
    {"UnknownTable", "name = \"a\"\n[terrrain]\nsources = [\"a\"]\n", 2, "terrrain"},
    {"UnknownKey", "[terrain]\nsources = [\"a\"]\nvoid = \"hole\"\n", 3, "\"void\""},
    {"EarliestUnknownKey", "[start]\nzz = 1\nyy = 2\n", 2, "\"zz\""},
    {"UnknownKeyInModel",
     "[[models]]\nsource = \"a\"\nposition = [1, 2]\n[[models]]\nsource = \"b\"\n"
     "position = [1, 2]\nheight = 3\n",
     7, "\"height\""},
    {"UnknownKeyInEdit",
     "[terrain]\nsources = [\"a\"]\n[[edits]]\nkind = \"crater\"\nposition = [1, 2]\nradius_m = 5\n"
     "depth_m = 2\ntime_s = 1\nslope_deg = 30\n",
     9, "\"slope_deg\""},
    {"EditWithoutTime", "[terrain]\nsources = [\"a\"]\n[[edits]]\nkind = \"raster\"\nsource = \"b\"\n", 3,
     "time_s"},
    {"UnknownKindOfEdit", "[terrain]\nsources = [\"a\"]\n[[edits]]\nkind = \"hole\"\ntime_s = 1\n", 4,
     "crater"},
    {"EditWithoutTerrain", "[[edits]]\nkind = \"raster\"\nsource = \"b\"\ntime_s = 1\n", 1, "[terrain]"},
    {"UnknownTopKey", "title = \"a\"\n", 1, "title"},
    {"TerrainIsNoTable", "terrain = 3\n", 1, "terrain"},
    {"TerrainWithoutSources", "name = \"x\"\n[terrain]\nvoids = \"fill\"\n", 2, "sources"},
    {"SourcesNotAList", "[terrain]\nsources = \"a.tif\"\n", 2, "sources"},
    {"SourcesEmpty", "[terrain]\nsources = []\n", 2, "sources"},
    {"SourcesOfNumbers", "[terrain]\nsources = [1]\n", 2, "sources"},
    {"UnknownVoids", "[terrain]\nsources = [\"a\"]\nvoids = \"keep\"\n", 3, "\"fill\" or \"hole\""},
    {"BuildingsNotAList", "[buildings]\nsource = \"a\"\n", 1, "[[buildings]]"},
    {"BuildingsWithoutSource", "[[buildings]]\ndefault_height_m = 3\n", 1, "source"},
    {"NegativeHeight", "[[buildings]]\nsource = \"a\"\ndefault_height_m = -3\n", 3, "0.1 to 1000"},
    {"HeightIsText", "[[buildings]]\nsource = \"a\"\ndefault_height_m = \"3\"\n", 3, "not a number"},
    {"HeightIsNan", "[[buildings]]\nsource = \"a\"\ndefault_height_m = nan\n", 3, "not a number"},
    {"SourceIsNumber", "[[buildings]]\nsource = 7\n", 2, "source"},
    {"ModelWithoutPosition", "[[models]]\nsource = \"a\"\n", 1, "position"},
    {"PositionTooShort", "[[models]]\nsource = \"a\"\nposition = [1]\n", 3, "1 numbers, expected 2"},
    {"ScaleZero", "[[models]]\nsource = \"a\"\nposition = [1, 2]\nscale = 0\n", 4, "scale"},
    {"InstrumentPosition", "[[instruments]]\nsource = \"a\"\nposition_m = [1, 2]\n", 3, "expected 3"},
    {"UnknownSignal",
     "[[instruments]]\nsource = \"a\"\nposition_m = [1, 2, 3]\ndrives = { n_1 = \"speed\" }\n", 4,
     "airspeed_mps"},
    {"DriveIsNumber", "[[instruments]]\nsource = \"a\"\nposition_m = [1, 2, 3]\ndrives = { n_1 = 4 }\n", 4,
     "n_1"},
    {"CameraTooShort", "[start]\ncamera = [1, 2, 3]\n", 2, "expected 6"},
    {"CameraOfText", "[start]\ncamera = [1, 2, 3, 4, 5, \"x\"]\n", 2, "not a number"},
    {"WideFov", "[start]\nfov_deg = 180\n", 2, "0.01 to 170"},
    {"PathWithoutKind", "[path]\nspeed_mps = 3\n", 1, "kind"},
    {"UnknownKind", "[path]\nkind = \"sail\"\nwaypoints = [[1, 2, 3], [2, 3, 4]]\n", 2,
     "\"flight\" or \"drive\""},
    {"OneWaypoint", "[path]\nkind = \"flight\"\nwaypoints = [[1, 2, 3]]\n", 3, "at least 2"},
    {"FlatWaypoints", "[path]\nkind = \"flight\"\nwaypoints = [1, 2, 3]\n", 3, "not a list"},
    {"FlightWithoutHeights", "[path]\nkind = \"flight\"\nwaypoints = [[1, 2], [2, 3]]\n", 3, "expected 3"},
    {"RecordingWithWaypoints", "[path]\nsource = \"a\"\nwaypoints = [[1, 2], [2, 3]]\n", 3, "waypoints"},
    {"SpeedZero", "[path]\nkind = \"drive\"\nwaypoints = [[1, 2], [2, 3]]\nspeed_mps = 0\n", 4, "speed_mps"},
    {"EndBeforeBegin", "[time]\nbegin_s = 5\nend_s = 5\n", 3, "end_s"},
    {"NotToml", "name = \"a\"\nwhat is this\n", 2, "TOML"},
    {"DuplicateTable", "[time]\nbegin_s = 1\n[time]\nend_s = 3\n", 3, "TOML"},
    {"UnclosedString", "name = \"a\n", 1, "TOML"},
};

INSTANTIATE_TEST_SUITE_P(All, SceneFileRefuses, testing::ValuesIn(kBadScenes),
                         [](const auto& bad) { return std::string(bad.param.name); });

TEST(SceneFile, MissingEmptyAndFolderAreErrorsNotCrashes) {
    const TempFolder folder;
    for (const std::string& file :
         {folder.file("none.toml"), folder.write("empty.toml", ""), folder.file("")}) {
        const auto scene = sim::read_scene(file);
        ASSERT_FALSE(scene);
        EXPECT_EQ(scene.message().find(file), 0u) << scene.message();
        EXPECT_EQ(scene.message().find('\n'), std::string::npos);
    }
}

TEST(SceneFile, EveryTruncationIsReadOrRefusedInOneLine) {
    const TempFolder folder;
    const std::string full = kFull;
    for (size_t length = 1; length < full.size(); length += 3) {
        const auto scene = sim::read_scene(folder.write("cut.toml", full.substr(0, length)));
        if (scene) continue;
        EXPECT_EQ(scene.message().find('\n'), std::string::npos) << length << ": " << scene.message();
    }
}

}  // namespace
