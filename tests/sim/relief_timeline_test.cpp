// Ground as a function of time: what a world shows at a time is what one built on that ground shows, whichever way the
// time was reached.
#include "sim/relief_timeline.h"

#include <gtest/gtest.h>

#include "data/ground_height.h"
#include "data/relief_edit.h"
#include "lod/scheduler.h"
#include "sim/schedule_options.h"
#include "sim/world.h"
#include "tests/sim/program.h"

namespace {

using sim_test::TempFolder;

const char* const kScene = R"(name = "Under fire"
[terrain]
sources = ["relief.asc"]
[[buildings]]
source = "house.geojson"
[[edits]]
kind = "excavation"
position = [300, 600]
radius_m = 80
depth_m = 30
slope_deg = 60
time_s = 20
[[edits]]
kind = "crater"
position = [480, 410]
radius_m = 60
depth_m = 25
time_s = 10
[start]
camera = [480.0, 40.0, 260.0, 0.0, -15.0, 0.0]
)";

const char* const kHouses = R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"building":"yes","height":12},"geometry":{"type":"Polygon",
"coordinates":[[[470,400],[500,400],[500,430],[470,430],[470,400]]]}},
{"type":"Feature","properties":{"building":"yes","height":9},"geometry":{"type":"Polygon",
"coordinates":[[[700,100],[720,100],[720,120],[700,120],[700,100]]]}}]})";

class ReliefInTime : public testing::Test {
  protected:
    void SetUp() override {
        folder_.write("relief.asc", sim_test::small_relief());
        folder_.write("house.geojson", kHouses);
    }
    std::unique_ptr<sim::World> build(const std::string& text) const {
        const auto scene = sim::read_scene(folder_.write("scene.toml", text));
        EXPECT_TRUE(scene) << scene.message();
        auto world = sim::build_world(*scene, {});
        EXPECT_TRUE(world) << world.message();
        return world ? std::move(*world) : nullptr;
    }
    TempFolder folder_;
};

/// Feet of walls: how far the lowest lies off the ground, and how many there are.
struct Feet {
    double worst_m = 0.0;
    size_t count = 0;
};
Feet feet_of(sim::World& world, std::vector<lod::Vertex>& pool) {
    world.objects->place(world.objects->pool_need());
    lod::DrawList list;
    world.objects->emit(lod::look_at({480, 40, 260}, {480, 400, 100}, {0, 0, 1}, {}), list);
    Feet feet;
    for (const lod::VertexWrite& write : list.vertex_writes) {
        pool.assign(write.vertices.begin(), write.vertices.end());
        for (const lod::Vertex& vertex : write.vertices) {
            if (vertex.colour[3] != static_cast<uint8_t>(lod::Material::kWallFoot)) continue;
            const glm::dvec3 at = lod::position_of(vertex);
            const double ground_m = sim::ground_height_m(world, {at.x, at.y, 0.0});
            feet.worst_m = std::max(feet.worst_m, std::abs(at.z - ground_m));
            ++feet.count;
        }
    }
    return feet;
}

std::vector<uint8_t> bytes_of(const std::vector<lod::Vertex>& vertices) {
    const auto* first = reinterpret_cast<const uint8_t*>(vertices.data());
    return {first, first + vertices.size() * sizeof(lod::Vertex)};
}

TEST_F(ReliefInTime, IsAFunctionOfTime) {
    const auto world = build(kScene);
    ASSERT_TRUE(world);
    const data::HeightGrid before = *world->ground;
    const auto colours = world->ground_colours.rgba;
    const uint64_t objects = world->objects->hash();

    // By hand, in the order of times, which is not that of the file.
    data::HeightGrid by_hand = before;
    const auto edit = [&](data::HeightBlock block) { data::exchange(by_hand, block); };
    const auto place = [&](double x, double y) { return before.frame.grid_from_site({x, y, 0.0}); };
    EXPECT_TRUE(sim::bring_relief_to(*world, 9.99).empty());
    EXPECT_EQ(sim::bring_relief_to(*world, 10.0).size(), 1u);
    edit(data::make_block(by_hand, data::Crater{place(480, 410), 60.0, 25.0, 5.0}));
    EXPECT_EQ(world->ground->height_m, by_hand.height_m);
    const auto colours_at_10 = world->ground_colours.rgba;
    EXPECT_NE(colours_at_10, colours);
    const float lowest_m = world->ground->min_m;

    EXPECT_EQ(sim::bring_relief_to(*world, 1e9).size(), 1u);
    edit(data::make_block(by_hand,
                          data::Excavation{place(300, 600), 80.0, 30.0, 60.0 * 3.14159265358979 / 180.0}));
    EXPECT_EQ(world->ground->height_m, by_hand.height_m);
    EXPECT_EQ(world->terrain->validate(), "");

    EXPECT_EQ(sim::bring_relief_to(*world, 12.0).size(), 1u);
    EXPECT_EQ(world->ground_colours.rgba, colours_at_10);
    EXPECT_EQ(world->ground->min_m, lowest_m);
    EXPECT_EQ(sim::bring_relief_to(*world, 0.0).size(), 1u);
    EXPECT_EQ(world->ground->height_m, before.height_m);
    EXPECT_EQ(world->ground->min_m, before.min_m);
    EXPECT_EQ(world->ground->max_m, before.max_m);
    EXPECT_EQ(world->ground_colours.rgba, colours);
    EXPECT_EQ(world->objects->hash(), objects);
    EXPECT_EQ(world->terrain->validate(), "");
}

TEST_F(ReliefInTime, ScheduleEndsWithTheLatestEdit) {
    const auto world = build(kScene);
    ASSERT_TRUE(world);
    EXPECT_EQ(sim::schedule_end_s(*world), 20.0);
}

TEST_F(ReliefInTime, BuildingsSettleWithTheirGround) {
    const auto world = build(kScene);
    ASSERT_TRUE(world);
    std::vector<lod::Vertex> before, after;
    EXPECT_LT(feet_of(*world, before).worst_m, 1e-3);
    const uint64_t hash = world->objects->hash();
    sim::bring_relief_to(*world, 10.0);
    const Feet feet = feet_of(*world, after);
    EXPECT_GT(feet.count, 8u);
    EXPECT_LT(feet.worst_m, 1e-3);
    EXPECT_NE(world->objects->hash(), hash);
    EXPECT_EQ(world->objects->validate(), "");
    // As a scene whose crater was there from the start; the other house has not moved.
    std::string early = kScene;
    early.replace(early.find("time_s = 10"), 11, "time_s = -9");
    const auto twin = build(early);
    ASSERT_TRUE(twin);
    sim::bring_relief_to(*twin, 0.0);
    std::vector<lod::Vertex> expected;
    feet_of(*twin, expected);
    EXPECT_EQ(bytes_of(after), bytes_of(expected));
    size_t moved = 0;
    for (size_t i = 0; i < before.size(); ++i)
        moved += lod::position_of(before[i]) != lod::position_of(after[i]) ? 1u : 0u;
    EXPECT_GT(moved, 8u);
    EXPECT_LT(moved, before.size());
}

/// A front that was taken through all edits draws, once converged, ground as true as it says.
TEST_F(ReliefInTime, WhatIsDrawnIsTheGroundOfThatTime) {
    const auto world = build(kScene);
    ASSERT_TRUE(world);
    sim::bring_relief_to(*world, 15.0);
    const terrain::DiamondTable& table = world->terrain->table();
    const terrain::DiamondTable anew = terrain::make_diamond_table(*world->ground, 1);
    for (size_t i = 0; i < anew.slots.size(); ++i) {
        ASSERT_EQ(table.slots[i].height_m, anew.slots[i].height_m);
        ASSERT_EQ(table.slots[i].error_code, anew.slots[i].error_code);
    }
}

TEST_F(ReliefInTime, RefusesWhatItCannotDo) {
    std::string far = kScene;
    far.replace(far.find("[480, 410]"), 10, "[9e6, 410]");
    const auto scene = sim::read_scene(folder_.write("far.toml", far));
    ASSERT_TRUE(scene) << scene.message();
    const auto world = sim::build_world(*scene, {});
    ASSERT_FALSE(world);
    EXPECT_NE(world.message().find("far.toml:13: [[edits]]"), std::string::npos) << world.message();
    std::string missing = kScene;
    missing += "[[edits]]\nkind = \"raster\"\nsource = \"none.tif\"\ntime_s = 3\n";
    const auto no_raster = sim::build_world(*sim::read_scene(folder_.write("none.toml", missing)), {});
    ASSERT_FALSE(no_raster);
    EXPECT_NE(no_raster.message().find("none.tif"), std::string::npos) << no_raster.message();
}

/// From outside: a picture at a time after the crater differs from one before, and one taken without edits is the
/// one before.
TEST_F(ReliefInTime, StillShowsItsTime) {
    if (!sim_test::has_program()) GTEST_SKIP() << "harrier is not built in " HARRIER_BINARY_DIR;
    const std::string scene = folder_.write("scene.toml", kScene);
    const std::string plain(kScene, std::string(kScene).find("[[edits]]"));
    const std::string bare =
        folder_.write("bare.toml", plain + "[start]\ncamera = [480.0, 40.0, 260.0, 0.0, -15.0, 0.0]\n");
    const auto picture = [&](const std::string& what) {
        const std::string file = folder_.file("p.png");
        const sim_test::Outcome outcome =
            sim_test::run_program(folder_, "still " + what + " --size 160x90 --image " + file);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return sim_test::read_all(file);
    };
    const std::string before = picture(scene + " --time 9"), after = picture(scene + " --time 10");
    EXPECT_NE(before, after);
    EXPECT_EQ(before, picture(bare + " --time 10"));
}

}  // namespace
