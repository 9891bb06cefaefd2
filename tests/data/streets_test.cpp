// Streets: which lines count, how wide they are, where they lie.
#include "data/streets.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "data/generated_town.h"
#include "tests/data/own_path.h"

namespace {

using data::Street;

const data::WorldFrame kPlane{false}, kEarth{true};

std::string write_lines(const std::string& name, const std::vector<std::string>& properties) {
    const std::string path = test::own_path(name);
    std::ofstream file(path);
    file << R"({"type":"FeatureCollection","features":[)";
    for (size_t i = 0; i < properties.size(); ++i) {
        file << (i == 0 ? "" : ",") << R"({"type":"Feature","properties":{)" << properties[i]
             << R"(},"geometry":{"type":"LineString","coordinates":[[)" << i << R"(,1],[)" << i
             << R"(,2],[5,3]]}})";
    }
    file << "]}";
    return path;
}

TEST(Streets, KindsForCarsCountAndHaveTheirWidth) {
    const auto streets = data::read_streets(
        write_lines("kinds.geojson",
                    {R"("highway":"residential")", R"("highway":"primary","width":"15")",
                     R"("highway":"footway")", R"("highway":"steps")",
                     R"("highway":"service","width":"wide")", R"("highway":"primary","tunnel":"yes")",
                     R"("highway":"primary","tunnel":"no")", R"("name":"brook")"}),
        kPlane);
    ASSERT_TRUE(streets) << streets.message();
    std::vector<double> widths;
    for (const Street& street : *streets) {
        widths.push_back(street.width_m);
        ASSERT_EQ(street.line.size(), 3u);
        EXPECT_EQ(street.line[2], glm::dvec2(5.0, 3.0));
    }
    EXPECT_EQ(widths, (std::vector<double>{7.0, 15.0, 4.5, 11.0}));
    EXPECT_EQ((*streets)[1].line[0], glm::dvec2(1.0, 1.0));
}

TEST(Streets, ASourceWithoutAnyGivesNone) {
    const auto none = data::read_streets(write_lines("none.geojson", {R"("name":"brook")"}), kPlane);
    ASSERT_TRUE(none) << none.message();
    EXPECT_TRUE(none->empty());
}

TEST(Streets, ATruncatedFileIsOneLine) {
    const std::string whole = write_lines("whole.geojson", {R"("highway":"primary")"});
    std::string text;
    std::getline(std::ifstream(whole), text, '\0');
    const std::string cut = test::own_path("cut.geojson");
    std::ofstream(cut) << text.substr(0, text.size() / 2);
    for (const std::string& path : {cut, std::string("/nowhere/streets.geojson")}) {
        const auto streets = data::read_streets(path, kPlane);
        ASSERT_FALSE(streets);
        EXPECT_NE(streets.message().find(path), std::string::npos);
        EXPECT_EQ(streets.message().find('\n'), std::string::npos);
    }
}

TEST(Streets, TheSampleTownHasTheGeneratedOnes) {
    const auto streets = data::read_streets(HARRIER_SOURCE_DIR "/data/samples/town.geojson", kEarth);
    ASSERT_TRUE(streets) << streets.message();
    EXPECT_EQ(streets->size(), data::generate_streets({}).size());
    for (const Street& street : *streets)
        EXPECT_EQ(street.width_m, data::TownOptions{}.street_width_m);
}

TEST(Streets, MonacosComeOutOfTheOsmExtract) {
    const std::string path = HARRIER_SOURCE_DIR "/../shared/data/monaco/monaco-2021.osm.pbf";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not on this machine";
    const auto streets = data::read_streets(path, kEarth);
    ASSERT_TRUE(streets) << streets.message();
    EXPECT_GT(streets->size(), 300u);
    for (const Street& street : *streets) {
        for (const glm::dvec2& site : street.line) {
            ASSERT_NEAR(site.x, 7.42, 0.3);
            ASSERT_NEAR(site.y, 43.74, 0.3);
        }
    }
}

}  // namespace
