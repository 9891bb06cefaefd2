#include "data/building_height.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "data/feature_tags.h"

namespace {

TEST(BuildingHeight, UnderstandsWhatMappersWrite) {
    const std::pair<const char*, double> understood[] = {
        {"12", 12},      {"12.5", 12.5},    {"12 m", 12},    {"12m", 12},        {"40 ft", 12.192},
        {"40'", 12.192}, {"12,5", 12.5},    {"3;4", 3},      {" 7 ", 7},         {".5", 0.5},
        {"0", 0},        {"5'10\"", 1.778}, {"9 metres", 9}, {"30 feet", 9.144}, {"6' 0\"", 1.8288},
    };
    for (const auto& [text, metres] : understood) {
        const std::optional<double> parsed = data::parse_length_m(text);
        ASSERT_TRUE(parsed) << text;
        EXPECT_NEAR(*parsed, metres, 1e-12) << text;
    }
    for (const char* text :
         {"", "tall", "-3", "12 storeys", "1.2.3", "nan", "inf", "1e3", "m", "'", "5'x", ";4", "12 m high"})
        EXPECT_FALSE(data::parse_length_m(text)) << text;
}

TEST(BuildingHeight, HeightGoesBeforeLevelsBeforeTheDefault) {
    const auto height = [](const data::BuildingTags& tags) { return data::building_height(tags, 8.0, 3.0); };
    EXPECT_EQ(height({}).height_m, 8.0);
    EXPECT_EQ(height({.height = "20", .levels = "3", .min_height = "", .min_level = ""}).height_m, 20.0);
    EXPECT_EQ(height({.height = "", .levels = "3", .min_height = "", .min_level = ""}).height_m, 9.0);
    EXPECT_EQ(height({.height = "5000", .levels = "3", .min_height = "", .min_level = ""}).height_m, 9.0);
    EXPECT_EQ(height({.height = "0.1", .levels = "x", .min_height = "", .min_level = ""}).height_m, 8.0);
    EXPECT_FALSE(height({.height = "0.1", .levels = "x", .min_height = "", .min_level = ""}).has_height);
    EXPECT_EQ(height({.height = "20", .levels = "", .min_height = "5", .min_level = "3"}).min_height_m, 5.0);
    EXPECT_EQ(height({.height = "20", .levels = "", .min_height = "", .min_level = "3"}).min_height_m, 9.0);
    EXPECT_EQ(height({.height = "20", .levels = "", .min_height = "20", .min_level = ""}).min_height_m, 0.0);
}

TEST(FeatureTags, FindsValuesAmongOtherTags) {
    const std::string tags = R"("a"=>"height","height"=>"12","say \"x\""=>"\"y\\","building:levels"=>"4")";
    EXPECT_EQ(data::hstore_value(tags, "height"), "12");
    EXPECT_EQ(data::hstore_value(tags, "building:levels"), "4");
    EXPECT_EQ(data::hstore_value(tags, "say \"x\""), "\"y\\");
    EXPECT_EQ(data::hstore_value(tags, "levels"), "");
    EXPECT_EQ(data::hstore_value("\"height\"=>\"1", "height"), "");
}

}  // namespace
