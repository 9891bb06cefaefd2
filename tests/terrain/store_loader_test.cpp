// The loader from outside: what a table shows is always the store's own bytes, within the limit, and soon.
#include "terrain/store/page_loader.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>

#include "tests/terrain/store_kit.h"

namespace {

using terrain_test::is_same_page;
using terrain_test::level_view;
using test::CutFolder;

const data::HeightGrid& relief() {
    static const data::HeightGrid grid = terrain_test::fractal_grid(1025, 1025, 10.0, 900.0, 1);
    return grid;
}
const terrain::DiamondTable& whole() {
    static const terrain::DiamondTable table = terrain::make_diamond_table(relief(), 2);
    return table;
}

struct Rig {
    explicit Rig(const terrain::PageLoaderOptions& options)
        : path(folder.file("a.hts")), paged(open(path, options)) {}

    static terrain::PagedTable open(const std::string& path, terrain::PageLoaderOptions options) {
        if (options.memory_bytes == 0) options.memory_bytes = terrain_test::room_for(40);
        auto opened = open_paged_table(terrain_test::build_and_open(relief(), path), options);
        EXPECT_TRUE(opened) << opened.message();
        return std::move(*opened);
    }
    size_t exchange(const glm::dvec3& eye, double time_s) {
        const lod::View view = level_view(eye, 0.5 + 0.1 * time_s, -0.2);
        return paged.loader->exchange({&view, 1}, time_s, paged.table);
    }
    std::vector<size_t> present() const {
        std::vector<size_t> pages;
        for (size_t page = 0; page < paged.table.slot_of_page.size(); ++page) {
            if (paged.table.slot_of_page[page] != terrain::DiamondTable::kAbsent) pages.push_back(page);
        }
        return pages;
    }
    /// Empty when what is present is right: own slots, the store's bytes, and the coarse pages among it.
    std::string fault() const {
        std::set<uint32_t> slots;
        const size_t slot_count = paged.table.slots.size() / terrain::kPageEntries;
        for (size_t page : present()) {
            if (!slots.insert(paged.table.slot_of_page[page]).second) return "two pages in one slot";
            if (!is_same_page(paged.table, whole(), page))
                return "foreign bytes in page " + std::to_string(page);
        }
        for (size_t page = 0; page < 3; ++page) {
            if (slots.count(paged.table.slot_of_page[page]) == 0) return "a coarse page is away";
        }
        return slots.size() <= slot_count ? "" : "more pages than slots";
    }

    CutFolder folder;
    std::string path;
    terrain::PagedTable paged;
};

TEST(PageLoader, KeepsItsLimitAndItsWord) {
    const uint64_t limit = terrain_test::room_for(40);
    Rig rig({.memory_bytes = limit, .waits = true});
    EXPECT_LE(rig.paged.loader->memory_bytes(), limit);
    EXPECT_LE(rig.paged.table.slots.size() * sizeof(terrain::DiamondSource), limit);
    lod::Rng rng(4);
    for (int frame = 0; frame < 150; ++frame) {
        rig.exchange({rng.between(0, 10000), rng.between(0, 10000), rng.between(600, 2500)}, frame * 0.6);
        ASSERT_EQ(rig.fault(), "") << "frame " << frame;
        ASSERT_EQ(rig.paged.loader->tally().here, rig.present().size());
    }
    EXPECT_GT(rig.paged.loader->tally().evictions, 100u);
}

TEST(PageLoader, TheSameFlightLoadsTheSamePages) {
    std::vector<std::vector<size_t>> seen[2];
    for (auto& pages : seen) {
        Rig rig({.memory_bytes = 0, .waits = true});
        for (int frame = 0; frame < 60; ++frame) {
            rig.exchange({1000 + 130.0 * frame, 2000 + 90.0 * frame, 700}, frame * 0.4);
            pages.push_back(rig.present());
        }
    }
    EXPECT_EQ(seen[0], seen[1]);
}

TEST(PageLoader, FullRoomHoldsAll) {
    Rig rig({.memory_bytes = terrain_test::room_for(100), .want_px = 0.0, .waits = true});
    const size_t before = rig.present().size();
    EXPECT_EQ(rig.exchange({5000, 5000, 900}, 0.0), 91u - before);
    EXPECT_EQ(rig.present().size(), 91u);
    EXPECT_EQ(rig.fault(), "");
}

TEST(PageLoader, TooLittleRoomIsTold) {
    const CutFolder folder;
    auto store = terrain_test::build_and_open(relief(), folder.file("a.hts"));
    const auto opened = open_paged_table(std::move(store), {.memory_bytes = 100'000});
    ASSERT_FALSE(opened);
    EXPECT_NE(opened.message().find("expected at least"), std::string::npos) << opened.message();
}

/// Pages go bad after the file was opened: those stay absent, everything else goes on, and it is said once.
TEST(PageLoader, DamageIsSaidOnceAndDrawnCoarser) {
    std::atomic<int> lines = 0;
    Rig rig({.memory_bytes = 0, .waits = true, .on_trouble = [&](const std::string& line) {
                 ++lines;
                 EXPECT_NE(line.find("a.hts"), std::string::npos);
                 EXPECT_EQ(line.find('\n'), std::string::npos);
             }});
    const uint64_t first = rig.paged.loader->store().header().size_bytes();
    std::fstream stream(rig.path, std::ios::binary | std::ios::in | std::ios::out);
    for (size_t page = 11; page < 91; page += 3) {
        stream.seekp(static_cast<std::streamoff>(first + page * terrain::kPageBytes + 1000));
        stream << "damaged";
    }
    stream.close();
    for (int frame = 0; frame < 40; ++frame) {
        rig.exchange({1000 + 200.0 * frame, 1000 + 200.0 * frame, 800}, frame * 0.7);
        ASSERT_EQ(rig.fault(), "");
    }
    EXPECT_EQ(lines, 1);
    EXPECT_GT(rig.paged.loader->tally().broken, 5u);
    EXPECT_GT(rig.present().size(), 10u);
    for (size_t page : rig.present())
        EXPECT_TRUE(page < 11 || (page - 11) % 3 != 0);
}

TEST(PageLoader, AFileCutAfterOpeningIsSurvived) {
    std::atomic<int> lines = 0;
    Rig rig({.memory_bytes = 0, .waits = true, .on_trouble = [&](const std::string&) { ++lines; }});
    const uint64_t first = rig.paged.loader->store().header().size_bytes();
    std::filesystem::resize_file(rig.path, first + 40 * terrain::kPageBytes + 17);
    for (int frame = 0; frame < 40; ++frame) {
        rig.exchange({1000 + 200.0 * frame, 1000 + 200.0 * frame, 800}, frame * 0.7);
        ASSERT_EQ(rig.fault(), "");
    }
    EXPECT_EQ(lines, 1);
}

/// In real time, at 300 m/s and 60 frames a second.
TEST(PageLoader, PagesAreThereBeforeTheyAreNeeded) {
    constexpr double kSpeed_mps = 300.0, kRate_hz = 60.0, kTolerance_px = 1.0;
    Rig rig({.memory_bytes = terrain_test::room_for(80)});
    terrain::PageJudge judge(rig.paged.loader->store());
    size_t needed = 0, late = 0;
    for (int frame = 0; frame < 1200; ++frame) {
        const auto next_frame = std::chrono::steady_clock::now() + std::chrono::milliseconds(2);
        const double time_s = frame / kRate_hz;
        const glm::dvec3 eye =
            glm::dvec3(1500, 1200, 900) + glm::dvec3(0.8, 0.6, 0.0) * (kSpeed_mps * time_s);
        rig.exchange(eye, time_s);
        std::this_thread::sleep_until(next_frame);
        if (frame < 60 || frame % 10 != 0) continue;
        judge.look({{level_view(eye, 0.5 + 0.1 * time_s, -0.2), glm::dvec3(0.0)}});
        for (size_t page = 0; page < rig.paged.table.slot_of_page.size(); ++page) {
            if (double(judge.worth_px(page)) < kTolerance_px) continue;
            ++needed;
            if (rig.paged.table.slot_of_page[page] == terrain::DiamondTable::kAbsent) ++late;
        }
    }
    RecordProperty("late_share", std::to_string(double(late) / double(needed)));
    EXPECT_GT(needed, 500u);
    EXPECT_LE(double(late), 0.02 * double(needed));
}

/// A frame's thread at full speed beside the worker: whatever is present is right at every moment.
TEST(PageLoader, NothingChangesUnderAFrame) {
    Rig rig({.memory_bytes = terrain_test::room_for(30)});
    lod::Rng rng(9);
    glm::dvec3 eye(5000, 5000, 700);
    for (int frame = 0; frame < 100'000 && rig.paged.loader->tally().loads < 200; ++frame) {
        if (frame % 150 == 0) eye = {rng.between(0, 10000), rng.between(0, 10000), rng.between(600, 1500)};
        eye += glm::dvec3(5.0, 3.0, 0.0);
        rig.exchange(eye, frame / 60.0);
        if (frame % 10 == 0) {
            ASSERT_EQ(rig.fault(), "") << "frame " << frame;
        }
    }
    rig.paged.loader->wait_until_settled();
    EXPECT_GT(rig.paged.loader->tally().loads, 100u);
}

TEST(PageLoader, MayGoAtAnyTime) {
    for (int round = 0; round < 5; ++round) {
        Rig rig({.memory_bytes = 0});
        for (int frame = 0; frame < round; ++frame)
            rig.exchange({5000, 5000, 700}, frame / 60.0);
    }
}

}  // namespace
