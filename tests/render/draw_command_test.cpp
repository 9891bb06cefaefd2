#include "render/draw_command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "lod/base/rng.h"

namespace {

using render::DrawCommand;

std::vector<DrawCommand> build(const std::vector<lod::DrawItem>& items,
                               const std::optional<lod::DrawItem>& sky) {
    std::vector<DrawCommand> out(items.size() + 1);
    out.resize(render::build_commands(items, sky, out));
    return out;
}

TEST(DrawCommand, CarriesEveryFieldOfItsItem) {
    const auto commands =
        build({{.index_count = 30, .first_index = 7, .base_vertex = -2, .instance = 5, .is_glass = false}},
              std::nullopt);
    ASSERT_EQ(commands.size(), 1u);
    EXPECT_EQ(commands[0].index_count, 30u);
    EXPECT_EQ(commands[0].instance_count, 1u);
    EXPECT_EQ(commands[0].first_index, 7u);
    EXPECT_EQ(commands[0].base_vertex, -2);
    EXPECT_EQ(commands[0].base_instance, 5u);
}

TEST(DrawCommand, NothingToDrawGivesNoCommand) {
    EXPECT_TRUE(build({}, std::nullopt).empty());
    EXPECT_TRUE(build({{.index_count = 0}, {.index_count = 0, .is_glass = true}}, std::nullopt).empty());
}

TEST(DrawCommand, SkyComesAfterOpaqueAndBeforeGlassBackwards) {
    const auto commands = build({{.index_count = 3, .first_index = 1, .is_glass = true},
                                 {.index_count = 3, .first_index = 2},
                                 {.index_count = 3, .first_index = 3, .is_glass = true},
                                 {.index_count = 3, .first_index = 4}},
                                lod::DrawItem{.index_count = 3, .first_index = 99});
    std::vector<uint32_t> order;
    for (const DrawCommand& command : commands)
        order.push_back(command.first_index);
    EXPECT_EQ(order, (std::vector<uint32_t>{2, 4, 99, 3, 1}));
}

TEST(DrawCommand, RandomListsAreOpaqueInOrderThenGlassBackwards) {
    lod::Rng rng(2);
    for (int round = 0; round < 200; ++round) {
        std::vector<lod::DrawItem> items(rng.below(40));
        for (uint32_t i = 0; i < items.size(); ++i) {
            items[i] = {.index_count = static_cast<uint32_t>(rng.below(4)) * 3,
                        .first_index = i,
                        .instance = static_cast<uint32_t>(rng.below(9)),
                        .is_glass = rng.below(3) == 0};
        }
        const auto commands = build(items, std::nullopt);
        std::erase_if(items, [](const lod::DrawItem& item) { return item.index_count == 0; });
        const auto glass = std::stable_partition(items.begin(), items.end(),
                                                 [](const lod::DrawItem& item) { return !item.is_glass; });
        std::reverse(glass, items.end());
        ASSERT_EQ(commands.size(), items.size()) << "round " << round;
        for (size_t i = 0; i < items.size(); ++i) {
            EXPECT_EQ(commands[i].first_index, items[i].first_index) << "round " << round;
            EXPECT_EQ(commands[i].base_instance, items[i].instance) << "round " << round;
        }
    }
}

TEST(DrawCommandDeathTest, RefusesARoomTooSmall) {
    std::vector<DrawCommand> out(1);
    const std::vector<lod::DrawItem> items(1);
    EXPECT_DEATH(render::build_commands(items, std::nullopt, out), "CHECK failed");
}

}  // namespace
