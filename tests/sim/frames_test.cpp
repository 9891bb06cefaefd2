// Frames of the built program: what `still` and `fly` write agrees with the contract and with itself.
#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/sim/program.h"

namespace {

using nlohmann::json;
using sim_test::Outcome;
using sim_test::read_all;
using sim_test::run_program;
using sim_test::TempFolder;

const char* const kScene = R"(name = "Small"
[terrain]
sources = ["relief.asc"]
[[buildings]]
source = "house.geojson"
[start]
camera = [480.0, 40.0, 260.0, 0.0, -15.0, 0.0]
[path]
kind = "flight"
waypoints = [[100, 100, 250], [600, 300, 220], [300, 800, 260]]
speed_mps = 80
)";

const char* const kHouse = R"({"type":"FeatureCollection","features":[{"type":"Feature",
"properties":{"building":"yes","height":12},"geometry":{"type":"Polygon",
"coordinates":[[[470,400],[500,400],[500,430],[470,430],[470,400]]]}}]})";

class Frames : public testing::Test {
  protected:
    void SetUp() override {
        if (!sim_test::has_program()) GTEST_SKIP() << "harrier is not built in " HARRIER_BINARY_DIR;
        folder_.write("relief.asc", sim_test::small_relief());
        folder_.write("house.geojson", kHouse);
        scene_ = folder_.write("scene.toml", kScene);
    }

    json fly(const std::string& options) const {
        const std::string report = folder_.file("r.json");
        const Outcome outcome =
            run_program(folder_, "fly " + scene_ + " --size 96x54 --report " + report + options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.status == 0 ? json::parse(read_all(report)) : json();
    }

    TempFolder folder_;
    std::string scene_;
};

TEST_F(Frames, StillSaysWhatItDrew) {
    const Outcome outcome = run_program(folder_, "still " + scene_ + " --size 96x54 --tolerance 0.5");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1);
    const json said = json::parse(outcome.out);
    EXPECT_EQ(said["converged"], true);
    EXPECT_LE(said["error_px"]["terrain"].get<double>(), 0.5);
    EXPECT_GT(said["triangles"]["terrain"].get<int>(), 0);
    EXPECT_GT(said["triangles"]["objects"].get<int>(), 0);
    EXPECT_EQ(said["triangles"]["instruments"].get<int>(), 0);
    EXPECT_GT(said["operations"].get<int>(), 0);
    EXPECT_NE(said["renderer"].get<std::string>(), "");
}

TEST_F(Frames, BudgetsStopEarly) {
    const auto still = [&](const std::string& options) {
        return json::parse(
            run_program(folder_, "still " + scene_ + " --tolerance 0 --size 96x54 " + options).out);
    };
    EXPECT_EQ(still("--ops 7")["operations"], 7);
    EXPECT_EQ(still("--ops 7")["converged"], false);
    EXPECT_LE(still("--triangles 60")["triangles"]["terrain"].get<int>(), 70);
}

TEST_F(Frames, DepthIsTheDistanceToTheGround) {
    // Straight down on the relief: the middle pixel's depth is the eye's height above the source ground.
    const std::string depth = folder_.file("d.tif");
    const Outcome outcome =
        run_program(folder_, "still " + scene_ +
                                 " --size 65x65 --camera 465,525,300,0,-90,0 --tolerance 0 --depth " + depth);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    GDALAllRegister();
    auto* file = GDALDataset::Open(depth.c_str());
    ASSERT_NE(file, nullptr);
    float middle = 0.0f;
    ASSERT_EQ(
        file->GetRasterBand(1)->RasterIO(GF_Read, 32, 32, 1, 1, &middle, 1, 1, GDT_Float32, 0, 0, nullptr),
        CE_None);
    GDALClose(file);
    // Site (465, 525) is sample (15, 15): corner + 15.5 cells; 33 rows from the north.
    const double ground_m = 100 + (15 * 15 + 3 * 15) % 41;
    EXPECT_NEAR(static_cast<double>(middle), 300.0 - ground_m, 0.2);
}

TEST_F(Frames, GeometryAtToleranceZeroIsTheSourceItself) {
    const std::string ply = folder_.file("g.ply");
    const Outcome outcome = run_program(
        folder_,
        "still " + scene_ + " --size 64x64 --camera 495,495,9000,0,-90,0 --tolerance 0 --geometry " + ply);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const std::string bytes = read_all(ply);
    size_t at = bytes.find("end_header\n") + 11;
    int samples = 0;
    const size_t count = std::stoul(bytes.substr(bytes.find("element vertex ") + 15));
    for (size_t i = 0; i < count; ++i, at += 24) {
        double p[3];
        std::memcpy(p, bytes.data() + at, sizeof p);
        const double col = p[0] / 30.0 - 0.5, row = 32.5 - p[1] / 30.0;
        if (std::abs(col - std::round(col)) > 1e-9 || std::abs(row - std::round(row)) > 1e-9)
            continue;  // the house
        const int c = static_cast<int>(std::lround(col)), r = static_cast<int>(std::lround(row));
        if (p[2] == 100 + (r * r + 3 * c) % 41) ++samples;
    }
    EXPECT_EQ(samples, 33 * 33);
}

TEST_F(Frames, EqualOperationsGiveEqualFrontsOnAnyThreads) {
    const json one = fly(" --frames 30 --ops 40 --threads 1");
    const json two = fly(" --frames 30 --ops 40 --threads 2");
    const json again = fly(" --frames 30 --ops 40 --threads 2");
    const json other = fly(" --frames 30 --ops 41 --threads 2");
    ASSERT_EQ(one["frames"].size(), 30u);
    bool any_differs = false;
    for (size_t i = 0; i < 30; ++i) {
        EXPECT_EQ(one["frames"][i]["front_hash"], two["frames"][i]["front_hash"]) << i;
        EXPECT_EQ(two["frames"][i]["front_hash"], again["frames"][i]["front_hash"]) << i;
        EXPECT_EQ(one["frames"][i]["operations"], again["frames"][i]["operations"]) << i;
        any_differs |= one["frames"][i]["front_hash"] != other["frames"][i]["front_hash"];
    }
    EXPECT_TRUE(any_differs);
}

TEST_F(Frames, OneDrawCallAFrameAndExactTimes) {
    const json report = fly(" --frames 20 --rate 50 --time 2 --ops 30");
    for (size_t i = 0; i < 20; ++i) {
        const json& frame = report["frames"][i];
        EXPECT_EQ(frame["draw_calls"], 1);
        EXPECT_EQ(frame["frame"], i);
        EXPECT_DOUBLE_EQ(frame["time_s"].get<double>(), 2.0 + 0.02 * static_cast<double>(i));
    }
}

TEST_F(Frames, RealTimeLoopKeepsTheClock) {
    const json report = fly(" --frames 20 --rate 20");
    ASSERT_EQ(report["frames"].size(), 20u);
    EXPECT_EQ(report["size"], json::array({96, 54}));
    for (const json& frame : report["frames"]) {
        const json& cpu = frame["cpu_ms"];
        const double stages_ms = cpu["update"].get<double>() + cpu["refine"].get<double>() +
                                 cpu["emit"].get<double>() + cpu["submit"].get<double>() +
                                 frame["render_ms"].get<double>();
        EXPECT_NEAR(frame["total_ms"].get<double>(), stages_ms, 0.5 + 0.05 * stages_ms);
        EXPECT_EQ(frame["missed"].get<bool>(), frame["total_ms"].get<double>() > 50.0);
    }
}

TEST_F(Frames, ImagesOfEveryFourthFrame) {
    fly(" --frames 9 --ops 10 --every 4 --images " + folder_.file("shots"));
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.file("shots"))) {
        files.push_back(entry.path().filename().string());
    }
    std::sort(files.begin(), files.end());
    EXPECT_EQ(files, (std::vector<std::string>{"frame_000000.png", "frame_000004.png", "frame_000008.png"}));
}

TEST_F(Frames, AnAbsentModuleCostsNothing) {
    const std::string empty = folder_.write("empty.toml", "name = \"nothing\"\n");
    const Outcome outcome = run_program(folder_, "still " + empty + " --size 32x18");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const json said = json::parse(outcome.out);
    for (const char* module : {"terrain", "objects", "instruments"}) {
        EXPECT_EQ(said["triangles"][module], 0);
        EXPECT_EQ(said["error_px"][module], 0.0);
    }
}

}  // namespace
