// The program from outside: bad input and bad usage end in one line and the right status, nothing is left behind.
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include "tests/sim/program.h"

namespace {

using sim_test::Outcome;
using sim_test::run_program;
using sim_test::TempFolder;

class Program : public testing::Test {
  protected:
    void SetUp() override {
        if (!sim_test::has_program()) GTEST_SKIP() << "harrier is not built in " HARRIER_BINARY_DIR;
        folder_.write("relief.asc", sim_test::small_relief());
    }

    /// Takes a picture of a scene with these contents.
    Outcome still(const std::string& scene, const std::string& options = "") const {
        return run_program(folder_,
                           "still " + folder_.write("scene.toml", scene) + " --size 64x36 " + options);
    }

    void expect_refused(const Outcome& outcome, const std::string& must_say) const {
        EXPECT_EQ(outcome.status, 1) << outcome.err;
        EXPECT_EQ(outcome.error_lines(), 1) << outcome.err;
        EXPECT_NE(outcome.err.find("harrier: "), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find(must_say), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("expected"), std::string::npos) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }

    const std::string relief_ = "[terrain]\nsources = [\"relief.asc\"]\n";
    TempFolder folder_;
};

TEST_F(Program, MissingScene) {
    expect_refused(run_program(folder_, "still " + folder_.file("none.toml")), "none.toml");
    expect_refused(run_program(folder_, "fly " + folder_.file("none.toml")), "none.toml");
    expect_refused(run_program(folder_, "demo --scene " + folder_.file("none.toml")), "none.toml");
}

TEST_F(Program, UnknownKey) {
    expect_refused(still(relief_ + "voidz = \"hole\"\n"), "scene.toml:3: ");
}

TEST_F(Program, MissingEmptyAndTruncatedElevation) {
    expect_refused(still("[terrain]\nsources = [\"none.tif\"]\n"), "none.tif");
    folder_.write("empty.tif", "");
    expect_refused(still("[terrain]\nsources = [\"empty.tif\"]\n"), "empty.tif");
    folder_.write("cut.tif", std::string("II*\0\x08\0\0\0", 8));
    expect_refused(still("[terrain]\nsources = [\"cut.tif\"]\n"), "cut.tif");
    folder_.write("text.tif", "this is no picture at all\n");
    expect_refused(still("[terrain]\nsources = [\"text.tif\"]\n"), "text.tif");
}

TEST_F(Program, ElevationOfNothingButVoids) {
    folder_.write("void.asc",
                  "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n"
                  "-9999 -9999\n-9999 -9999\n");
    expect_refused(still("[terrain]\nsources = [\"void.asc\"]\n"), "void.asc");
}

TEST_F(Program, ElevationOfOneSample) {
    folder_.write("one.asc", "ncols 1\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n7\n");
    const Outcome outcome = still("[terrain]\nsources = [\"one.asc\"]\n");
    EXPECT_TRUE(outcome.status == 0 || (outcome.status == 1 && outcome.error_lines() == 1)) << outcome.err;
}

TEST_F(Program, ElevationInACrsOfNoPlace) {
    GDALAllRegister();
    auto* file = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(folder_.file("far.tif").c_str(), 4,
                                                                          4, 1, GDT_Float32, nullptr);
    double place[6] = {1e9, 1000, 0, 1e9, 0, -1000};  // degrees, said to be
    file->SetGeoTransform(place);
    OGRSpatialReference reference;
    reference.importFromEPSG(4326);
    file->SetSpatialRef(&reference);
    GDALClose(file);
    expect_refused(still("[terrain]\nsources = [\"far.tif\"]\n"), "far.tif");
}

TEST_F(Program, MissingSources) {
    expect_refused(still(relief_ + "imagery = [\"none.png\"]\n", "--image " + folder_.file("a.png")),
                   "none.png");
    expect_refused(still(relief_ + "[[buildings]]\nsource = \"none.pbf\"\n"), "none.pbf");
    expect_refused(still(relief_ + "[[models]]\nsource = \"none.glb\"\nposition = [5, 5]\n"), "none.glb");
    expect_refused(still(relief_ + "[[instruments]]\nsource = \"none.ac\"\nposition_m = [0, 0, -1]\n"),
                   "none.ac");
    expect_refused(still(relief_ + "[[objects]]\nsource = \"none.hdlod\"\n"), "none.hdlod");
}

TEST_F(Program, MissingTrajectory) {
    folder_.write("scene.toml", relief_);
    expect_refused(
        run_program(folder_, "fly " + folder_.file("scene.toml") + " --trajectory " + folder_.file("no.csv")),
        "no.csv");
}

TEST_F(Program, UnusableFootprints) {
    folder_.write("empty.osm.pbf", "");
    folder_.write("cut.geojson", R"({"type":"FeatureCollection","features":[{"type":"Feature","prop)");
    folder_.write("line.geojson",
                  R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},)"
                  R"("geometry":{"type":"LineString","coordinates":[[0,0],[9,9]]}}]})");
    folder_.write("notes.txt", "nothing that could be a town\n");
    for (const char* name : {"empty.osm.pbf", "cut.geojson", "line.geojson", "notes.txt"})
        expect_refused(still(relief_ + "[[buildings]]\nsource = \"" + name + "\"\n"), name);
}

TEST_F(Program, TruncatedModels) {
    folder_.write("cut.glb", std::string("glTF\x02\0\0\0\xff\0\0\0", 12));
    folder_.write("cut.gltf", R"({"asset":{"version":"2.0"},)");
    folder_.write("cut.ac", "AC3Db\nOBJECT world\nkids 1\nOBJECT poly\nnumvert 3\n0 0 0\n");
    folder_.write("cut.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2");
    folder_.write("cut.ply", "ply\nformat ascii 1.0\nelement vertex 3\n");
    folder_.write("cut.stl", "solid half\nfacet normal 0 0 1\n");
    folder_.write("empty.glb", "");
    for (const char* name : {"cut.glb", "cut.gltf", "cut.ac", "cut.obj", "cut.ply", "cut.stl", "empty.glb"}) {
        const std::string source = std::string("source = \"") + name + "\"\n";
        expect_refused(still(relief_ + "[[models]]\n" + source + "position = [5, 5]\n"), name);
        expect_refused(still(relief_ + "[[instruments]]\n" + source + "position_m = [0, 0, -1]\n"), name);
    }
}

TEST_F(Program, UnusableRecordings) {
    folder_.write("empty.csv", "");
    folder_.write("columns.csv", "a,b,c\n1,2,3\n");
    folder_.write("short.csv", "time,x,y,height\n0,100,100,300\n1,110,100,3");
    folder_.write("cut.gpx", "<?xml version=\"1.0\"?>\n<gpx version=\"1.1\"><trk><trkseg>");
    for (const char* name : {"empty.csv", "columns.csv", "short.csv", "cut.gpx", "none.csv", "none.gpx"}) {
        const std::string scene =
            folder_.write("flight.toml", relief_ + "[path]\nsource = \"" + name + "\"\n");
        expect_refused(run_program(folder_, "fly " + scene), name);
        folder_.write("scene.toml", relief_);
        expect_refused(
            run_program(folder_, "fly " + folder_.file("scene.toml") + " --trajectory " + folder_.file(name)),
            name);
    }
}

TEST_F(Program, CutRecordingIsSaidAndFlownToItsLastWholeLine) {
    folder_.write("cut.csv", "time,x,y,height\n0,100,100,300\n1,110,100,300\n2,120,100,3");
    const Outcome outcome = still(relief_ + "[path]\nsource = \"cut.csv\"\n");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("note: " + folder_.file("cut.csv") + ": 1 of 3 rows"), std::string::npos)
        << outcome.err;
}

TEST_F(Program, MissingTextureIsSaidAndDrawnWithout) {
    folder_.write("box.mtl", "newmtl skin\nKd 0.5 0.4 0.3\nmap_Kd no_such.png\n");
    folder_.write("box.obj",
                  "mtllib box.mtl\nv 0 0 0\nv 9 0 0\nv 0 0 9\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl skin\n"
                  "f 1/1 2/2 3/3\n");
    const Outcome outcome = still(relief_ + "[[models]]\nsource = \"box.obj\"\nposition = [500, 500]\n");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("note: " + folder_.file("box.obj")), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("no_such.png"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("expected"), std::string::npos) << outcome.err;
}

TEST_F(Program, DriveOutsideTheTerrainIsRefused) {
    expect_refused(still(relief_ + "[path]\nkind = \"drive\"\nwaypoints = [[100, 100], [5000, 100]]\n"),
                   "no ground");
}

TEST_F(Program, FlightOutsideTheTerrainIsSaid) {
    const Outcome outcome =
        still(relief_ + "[path]\nkind = \"flight\"\nwaypoints = [[100, 100, 300], [5000, 100, 300]]\n");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("outside the terrain"), std::string::npos) << outcome.err;
}

TEST_F(Program, PlacesThatAreNone) {
    expect_refused(still("[start]\ncamera = [500000, 4800000, 100, 0, 0, 0]\n"), "500000");
}

TEST_F(Program, UnwritableOutputsAreToldBeforeTheWork) {
    expect_refused(still(relief_, "--image " + folder_.file("no/a.png")), "a.png");
    expect_refused(still(relief_, "--geometry " + folder_.file("no/a.ply")), "a.ply");
    expect_refused(
        run_program(folder_, "fly " + folder_.file("scene.toml") + " --report " + folder_.file("no/r.json")),
        "r.json");
}

TEST_F(Program, BadUsageHasItsOwnStatus) {
    folder_.write("scene.toml", relief_);
    const std::string scene = folder_.file("scene.toml");
    for (const std::string& words :
         {std::string(), std::string("glide"), std::string("still"), "still " + scene + " --sise 3x4",
          "still " + scene + " --size 0x4", "still " + scene + " --size 64",
          "still " + scene + " --eye 1,2,3", "still " + scene + " --camera 1,2,3",
          "still " + scene + " --camera 1,2,3,4,5,nan", "still " + scene + " --tolerance -1",
          "still " + scene + " --fov 180", "fly " + scene + " --rate 0", "fly " + scene + " --frames -3",
          "fly " + scene + " --ops many", "fly " + scene + " --every 0"}) {
        const Outcome outcome = run_program(folder_, words);
        EXPECT_EQ(outcome.status, 2) << words;
        EXPECT_NE(outcome.err, "") << words;
    }
}

TEST_F(Program, ExtractRefusesWhatItCannotReadOrWrite) {
    const std::string out = " --max-error 1 --out " + folder_.file("m.ply");
    expect_refused(run_program(folder_, "terrain extract " + folder_.file("none.tif") + out), "none.tif");
    const std::string nowhere = " --max-error 1 --out " + folder_.file("no/m.ply");
    expect_refused(run_program(folder_, "terrain extract " + folder_.file("relief.asc") + nowhere), "m.ply");
    EXPECT_EQ(run_program(folder_, "terrain extract " + folder_.file("relief.asc")).status, 2);
    EXPECT_EQ(run_program(folder_, "terrain").status, 2);
    EXPECT_FALSE(std::filesystem::exists(folder_.file("m.ply")));
}

TEST_F(Program, HelpIsNoMistake) {
    for (const char* words :
         {"--help", "still --help", "fly --help", "demo --help", "terrain extract --help"}) {
        const Outcome outcome = run_program(folder_, words);
        EXPECT_EQ(outcome.status, 0) << words;
        EXPECT_NE(outcome.out.find("--"), std::string::npos) << words;
    }
}

TEST_F(Program, FailureLeavesNoFiles) {
    const Outcome outcome = still(relief_ + "[[models]]\nsource = \"none.glb\"\nposition = [5, 5]\n",
                                  "--image " + folder_.file("a.png") + " --depth " + folder_.file("a.tif"));
    EXPECT_EQ(outcome.status, 1);
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.file(""))) {
        files.push_back(entry.path().filename().string());
    }
    std::sort(files.begin(), files.end());
    EXPECT_EQ(files, (std::vector<std::string>{"relief.asc", "scene.toml"}));
}

}  // namespace
