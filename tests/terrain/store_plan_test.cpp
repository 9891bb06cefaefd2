// Which pages a plan wants and lets go, without file or thread: the room is never exceeded, parents come first and
// go last, and nothing is carried to and fro.
#include "terrain/store/page_plan.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "terrain/store/page_tree.h"
#include "tests/terrain/store_kit.h"

namespace {

using terrain_test::level_view;

/// A plan at work for one eye; every load and every departure takes no time.
struct Rig {
    explicit Rig(size_t room, float want_px = 0.5f)
        : store(terrain_test::build_and_open(terrain_test::fractal_grid(1025, 1025, 10.0, 900.0, 1),
                                             folder.file("a.hts"))),
          judge(store),
          plan(store.directory(), room, want_px),
          slot_count(room) {}

    /// One look, then loads and departures until nothing changes.
    void settle(const glm::dvec3& eye, double age_s) {
        judge.look({{level_view(eye, 0.5, -0.3), glm::dvec3(0.0)}});
        plan.look(judge, age_s);
        std::vector<size_t> leavers;
        do {
            while (const auto placement = plan.next())
                come(*placement);
            leavers.clear();
            plan.choose_leavers(leavers);
            for (size_t page : leavers)
                leave(page);
        } while (!leavers.empty());
    }

    void come(const terrain::PagePlan::Placement& placement) {
        EXPECT_LT(placement.slot, slot_count);
        EXPECT_GE(placement.slot, plan.pinned_count());
        EXPECT_TRUE(taken.insert(placement.slot).second) << "a slot was given twice";
        EXPECT_TRUE(slots.emplace(placement.page, placement.slot).second);
        EXPECT_TRUE(is_here(above(placement.page)))
            << "page " << placement.page << " before the one above it";
    }
    void leave(size_t page) {
        EXPECT_GE(page, plan.pinned_count());
        terrain::for_each_child(store.layout(), store.layout().id(page), [&](const terrain::PageId& child) {
            EXPECT_EQ(slots.count(store.layout().number(child)), 0u) << "gone before a page below";
        });
        taken.erase(slots.at(page));
        slots.erase(page);
        plan.has_left(page);
    }
    size_t above(size_t page) const {
        return store.layout().number(parent_of(store.layout(), store.layout().id(page)));
    }
    bool is_here(size_t page) const { return page < plan.pinned_count() || slots.count(page) > 0; }

    test::CutFolder folder;
    terrain::StoreFile store;
    terrain::PageJudge judge;
    terrain::PagePlan plan;
    size_t slot_count;
    std::map<size_t, uint32_t> slots;
    std::set<uint32_t> taken;
};

TEST(PagePlan, ComesFromTheTopAndFillsTheRoomOnly) {
    Rig rig(40);
    EXPECT_EQ(rig.plan.pinned_count(), 5u);
    lod::Rng rng(5);
    for (int step = 0; step < 200; ++step) {
        rig.settle({rng.between(0, 10000), rng.between(0, 10000), rng.between(700, 3000)}, step * 0.7);
        EXPECT_LE(rig.plan.tally().here, 40u);
    }
    EXPECT_GT(rig.plan.tally().evictions, 100u);
}

TEST(PagePlan, WantsEverythingWhereEverythingMatters) {
    Rig rig(91, 0.0f);
    rig.settle({5000, 5000, 1000}, 0.0);
    EXPECT_EQ(rig.plan.tally().here, 91u);
    EXPECT_EQ(rig.plan.tally().missing, 0u);
}

TEST(PagePlan, AnEyeThatTremblesMovesNothing) {
    Rig rig(30);
    rig.settle({5000, 5000, 700}, 0.0);
    const uint64_t loads = rig.plan.tally().loads;
    EXPECT_GT(rig.plan.tally().missing + loads, 25u) << "the room is too large for this test";
    for (int step = 1; step < 400; ++step)
        rig.settle({5000 + 40.0 * (step % 2), 5000 - 30.0 * (step % 3), 700}, step * 0.1);
    EXPECT_LE(rig.plan.tally().loads, loads + 3);
}

TEST(PagePlan, ToAndFroLoadsAPageOnceAWay) {
    Rig rig(40);
    constexpr int kWays = 10;
    for (int way = 0; way < kWays; ++way) {
        for (int step = 0; step <= 60; ++step) {
            const double share = (way % 2 == 0 ? step : 60 - step) / 60.0;
            rig.settle({1000 + 8000 * share, 2000 + 6000 * share, 800}, (way * 61 + step) * 0.5);
        }
    }
    // Once more for what lies where a way ends and the next begins.
    EXPECT_LE(rig.plan.tally().most_loads, uint32_t{kWays} + 1);
}

TEST(PagePlan, JumpsBetweenTwoPlacesWaitOutTheLinger) {
    Rig rig(30);
    // Ten jumps a second: without a rule, every one would exchange all.
    for (int step = 0; step < 600; ++step)
        rig.settle(step % 2 == 0 ? glm::dvec3(1500, 1500, 700) : glm::dvec3(8500, 8500, 700), step * 0.1);
    EXPECT_LE(rig.plan.tally().most_loads, 3u);
}

TEST(PagePlan, GivesUpWhatCannotBeRead) {
    Rig rig(40);
    rig.judge.look({{level_view({5000, 5000, 800}, 0.5, -0.3), glm::dvec3(0.0)}});
    rig.plan.look(rig.judge, 0.0);
    const auto first = rig.plan.next();
    ASSERT_TRUE(first);
    rig.plan.give_up(first->page);
    EXPECT_EQ(rig.plan.tally().broken, 1u);
    rig.plan.look(rig.judge, 5.0);
    while (const auto placement = rig.plan.next()) {
        EXPECT_NE(placement->page, first->page);
        EXPECT_NE(rig.above(placement->page), first->page) << "of no use without the one above";
    }
}

}  // namespace
