#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/sim/program.h"

namespace sim {
namespace {

using sim_test::Outcome;
using sim_test::run_program;

class Generate : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!sim_test::has_program()) GTEST_SKIP() << "harrier is not built in " HARRIER_BINARY_DIR;
    }
    nlohmann::json summary(const std::string& words) {
        const Outcome outcome = run_program(folder_, words);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out, nullptr, false);
    }
    sim_test::TempFolder folder_;
};

TEST_F(Generate, TheConstructionSiteHasItsCounts) {
    const nlohmann::json json =
        summary("objects generate --family site --seed 7 --out " + folder_.file("site"));
    EXPECT_EQ(json["static"]["objects"], 498);
    EXPECT_EQ(json["static"]["triangles"], 66784);
    EXPECT_EQ(json["pseudo_dynamic"]["objects"], 40010);
    EXPECT_EQ(json["pseudo_dynamic"]["triangles"], 2879506);
    EXPECT_EQ(json["dynamic"]["objects"], 15649);
    EXPECT_EQ(json["dynamic"]["triangles"], 1313767);
    EXPECT_TRUE(std::filesystem::exists(folder_.file("site") + "/scene.glb"));
    EXPECT_TRUE(std::filesystem::exists(folder_.file("site") + "/scene.csv"));
}

TEST_F(Generate, GlbToFbxToGlbLosesNothing) {
    const std::string options =
        "--family group --objects 900 --triangles 33 --events 2.5 --moving 0.2 --seed 5";
    nlohmann::json first = summary("objects generate " + options + " --out " + folder_.file("a.glb"));
    nlohmann::json fbx =
        summary("objects convert " + folder_.file("a.glb") + " --out " + folder_.file("b.fbx"));
    nlohmann::json last =
        summary("objects convert " + folder_.file("b.fbx") + " --out " + folder_.file("c.glb"));
    for (nlohmann::json* json : {&first, &fbx, &last}) {
        ASSERT_TRUE(json->is_object());
        EXPECT_NEAR((*json)["end_s"].get<double>(), 600.0, 1e-9);
        json->erase("files");
        json->erase("end_s");
    }
    EXPECT_EQ(first["dynamic"]["objects"].get<int>() + first["pseudo_dynamic"]["objects"].get<int>(), 900);
    EXPECT_EQ(first, fbx);
    EXPECT_EQ(first, last);
}

TEST_F(Generate, RefusalsLeaveNothingBehind) {
    const auto refused = [&](const std::string& words, int status) {
        const Outcome outcome = run_program(folder_, words);
        EXPECT_EQ(outcome.status, status) << words;
        EXPECT_TRUE(status != 1 || outcome.error_lines() == 1) << outcome.err;
    };
    refused("objects generate --out " + folder_.file("a.obj"), 1);
    refused("objects generate --out /nowhere/a.glb", 1);
    refused("objects convert " + folder_.file("none.glb") + " --out " + folder_.file("a.glb"), 1);
    refused("objects generate --family group --objects 10 --duration 1e9 --out " + folder_.file("a.fbx"), 1);
    refused("objects generate --family village --out " + folder_.file("a.glb"), 2);
    refused("objects generate --family group --sparsity 1.5 --out " + folder_.file("a.glb"), 2);
    refused("objects generate", 2);
    refused("objects", 2);
    EXPECT_TRUE(std::filesystem::is_empty(folder_.file(""))) << "nothing is left";
}

}  // namespace
}  // namespace sim
