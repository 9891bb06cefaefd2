// `terrain build` and scenes that name its store: what is drawn is what the raster itself would give.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/sim/program.h"

namespace {

using nlohmann::json;
using sim_test::run_program;
using sim_test::TempFolder;

const std::string kRaster = HARRIER_SOURCE_DIR "/data/samples/jacksboro.tif";

std::string scene_of(const std::string& sources) {
    return "[terrain]\nsources = [" + sources + "]\nmemory_mb = 16\n";
}

class PagedScene : public testing::Test {
  protected:
    void SetUp() override {
        if (!sim_test::has_program()) GTEST_SKIP() << "the program is not built";
        const auto built = run_program(folder, "terrain build " + kRaster + " --out " + folder.file("a.hts"));
        ASSERT_EQ(built.status, 0) << built.err;
        const json said = json::parse(built.out);
        EXPECT_EQ(said.at("width"), 403);
        EXPECT_EQ(said.at("height"), 344);
        EXPECT_EQ(said.at("bytes"), std::filesystem::file_size(folder.file("a.hts")));
        folder.write("raster.toml", scene_of("\"" + kRaster + "\""));
        folder.write("store.toml", scene_of("\"a.hts\""));
    }
    TempFolder folder;
};

TEST_F(PagedScene, GivesTheSameDepthsByteForByte) {
    // Converged, and stopped in the middle: with counted operations nothing depends on when a page comes.
    for (const char* effort : {"", " --ops 700"}) {
        std::string depths[2];
        for (int i = 0; i < 2; ++i) {
            const std::string scene = folder.file(i == 0 ? "raster.toml" : "store.toml");
            const auto still = run_program(
                folder, "still " + scene + " --size 320x180 --depth " + folder.file("a.tif") + effort);
            ASSERT_EQ(still.status, 0) << still.err;
            depths[i] = sim_test::read_all(folder.file("a.tif"));
        }
        EXPECT_GT(depths[0].size(), 10'000u);
        EXPECT_EQ(depths[0], depths[1]);
    }
}

TEST_F(PagedScene, IsTheOnlySource) {
    folder.write("two.toml", scene_of("\"a.hts\", \"" + kRaster + "\""));
    const auto still = run_program(folder, "still " + folder.file("two.toml") + " --size 32x18");
    EXPECT_EQ(still.status, 1);
    EXPECT_EQ(still.error_lines(), 1);
    EXPECT_NE(still.err.find("expected it to be the only one"), std::string::npos) << still.err;
}

TEST_F(PagedScene, DamageIsOneLine) {
    std::string bytes = sim_test::read_all(folder.file("a.hts"));
    bytes[2000] = static_cast<char>(bytes[2000] ^ 1);
    folder.write("a.hts", bytes);
    const auto still = run_program(folder, "still " + folder.file("store.toml") + " --size 32x18");
    EXPECT_EQ(still.status, 1);
    EXPECT_EQ(still.error_lines(), 1);
    EXPECT_NE(still.err.find("a.hts"), std::string::npos) << still.err;
}

}  // namespace
