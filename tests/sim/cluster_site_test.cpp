// Cluster files from the command line to the picture.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/sim/program.h"

namespace {

using namespace sim_test;

constexpr int kObjects = 300, kTriangles = 20;

class ClusterSite : public testing::Test {
  protected:
    void SetUp() override {
        const Outcome made =
            run_program(folder_, "objects generate --family group --objects 300 --triangles 20 --out " +
                                     folder_.file("town"));
        ASSERT_EQ(made.status, 0) << made.err;
        const Outcome built = run_program(folder_, "objects build " + folder_.file("town") +
                                                       "/scene.glb --out " + folder_.file("town.hdlod"));
        ASSERT_EQ(built.status, 0) << built.err;
        built_ = nlohmann::json::parse(built.out);
    }

    /// Everything appears once: at T all is there.
    Outcome still(const std::string& objects, const std::string& options) {
        folder_.write("scene.toml", "[[objects]]\nsource = \"town.hdlod\"\n" + objects +
                                        "[start]\ncamera = [0, 0, 3000, 0, -89, 0]\n");
        return run_program(folder_, "still " + folder_.file("scene.toml") + " --size 64x36 " + options);
    }

    TempFolder folder_;
    nlohmann::json built_;
};

TEST_F(ClusterSite, IsBuiltInspectedAndDrawn) {
    EXPECT_EQ(built_["objects"], kObjects);
    const Outcome inspected = run_program(folder_, "objects inspect " + folder_.file("town.hdlod"));
    ASSERT_EQ(inspected.status, 0) << inspected.err;
    nlohmann::json kept = built_;
    kept.erase("work");  // of the build, not of the file
    EXPECT_EQ(nlohmann::json::parse(inspected.out), kept);
    const Outcome all = still("", "--time 1e6 --tolerance 0");
    ASSERT_EQ(all.status, 0) << all.err;
    EXPECT_EQ(nlohmann::json::parse(all.out)["triangles"]["objects"], kObjects * kTriangles);
    const Outcome few = still("", "--time 1e6 --tolerance 2");
    ASSERT_EQ(few.status, 0) << few.err;
    EXPECT_LT(nlohmann::json::parse(few.out)["triangles"]["objects"], kObjects * kTriangles / 2);
    EXPECT_LE(nlohmann::json::parse(few.out)["error_px"]["objects"], 2.0);
    const Outcome none = still("", "--time -5 --tolerance 0");
    ASSERT_EQ(none.status, 0) << none.err;
    EXPECT_EQ(nlohmann::json::parse(none.out)["triangles"]["objects"], 0);
}

TEST_F(ClusterSite, DamagedFilesAreOneLine) {
    std::ostringstream whole;
    whole << std::ifstream(folder_.file("town.hdlod"), std::ios::binary).rdbuf();
    const std::string bytes = whole.str();
    for (size_t size : {size_t{0}, size_t{20}, bytes.size() / 2, bytes.size() - 1}) {
        folder_.write("cut.hdlod", bytes.substr(0, size));
        const Outcome outcome = run_program(folder_, "objects inspect " + folder_.file("cut.hdlod"));
        EXPECT_EQ(outcome.status, 1);
        EXPECT_NE(outcome.err.find("cut.hdlod"), std::string::npos);
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
}

TEST_F(ClusterSite, AnUnknownKeyNamesItsLine) {
    const Outcome outcome = still("colour = \"red\"\n", "");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("scene.toml:"), std::string::npos) << outcome.err;
}

}  // namespace
