// The store on disk: the same table as in memory, bit for bit, or one line that says why not.
#include "terrain/store/store_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/terrain/store_kit.h"

namespace {

using test::CutFolder;

void expect_round_trip(const data::HeightGrid& grid) {
    const CutFolder folder;
    const terrain::StoreFile store = terrain_test::build_and_open(grid, folder.file("a.hts"));
    const terrain::DiamondTable whole = terrain::make_diamond_table(grid, 2);
    terrain::DiamondTable read = store.make_table();
    ASSERT_EQ(store.layout().page_count(), whole.layout.page_count());
    std::vector<terrain::DiamondSource> page(terrain::kPageEntries);
    for (size_t i = 0; i < store.layout().page_count(); ++i) {
        const auto outcome = store.read_page(i, page);
        ASSERT_TRUE(outcome) << outcome.message();
        ASSERT_EQ(std::memcmp(page.data(), &whole.slots[i * terrain::kPageEntries], terrain::kPageBytes), 0)
            << i;
    }
    EXPECT_EQ(read.min_m, whole.min_m);
    EXPECT_EQ(read.max_m, whole.max_m);
    EXPECT_EQ(read.has_voids, whole.has_voids);
    EXPECT_EQ(std::memcmp(read.corners, whole.corners, sizeof(whole.corners)), 0);
    EXPECT_EQ(read.frame.chord_error_per_cell2().up_m, whole.frame.chord_error_per_cell2().up_m);
    for (int i = 0; i <= 10; ++i) {
        const int x = (grid.width - 1) * i / 10, y = (grid.height - 1) * (10 - i) / 10;
        EXPECT_EQ(read.frame.world_from_sample(x, y, 100.0), grid.frame.world_from_sample(x, y, 100.0));
    }
    const auto mapped = store.map_table();
    ASSERT_TRUE(mapped) << mapped.message();
    for (size_t i = 0; i < store.layout().page_count(); ++i)
        ASSERT_TRUE(terrain_test::is_same_page(*mapped, whole, i));
}

TEST(StoreFile, HoldsTheTableOfASquare) {
    expect_round_trip(terrain_test::fractal_grid(257, 257, 10.0, 300.0, 1));
}
TEST(StoreFile, HoldsTheTableOfAnOddRectangle) {
    expect_round_trip(terrain_test::fractal_grid(600, 131, 10.0, 300.0, 2));
}
TEST(StoreFile, HoldsTheTableOfTheSmallestRaster) {
    expect_round_trip(terrain_test::fractal_grid(2, 2, 10.0, 30.0, 3));
}
TEST(StoreFile, HoldsVoids) {
    expect_round_trip(terrain_test::half_void_grid(301, 280));
}
TEST(StoreFile, HoldsAPlaceOnTheEarth) {
    expect_round_trip(terrain_test::geographic_grid(300, 513));
}

std::string bytes_of(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}
void write_bytes(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}
void flip_byte(const std::string& path, uint64_t place, unsigned bits) {
    std::fstream stream(path, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekg(static_cast<std::streamoff>(place));
    const int byte = stream.get();
    stream.seekp(static_cast<std::streamoff>(place));
    stream.put(static_cast<char>(static_cast<unsigned>(byte) ^ bits));
}

TEST(StoreFile, IsTheSameForAnyNumberOfThreads) {
    const CutFolder folder;
    const data::HeightGrid grid = terrain_test::half_void_grid(301, 280);
    ASSERT_TRUE(terrain::build_store(grid, folder.file("one.hts"), 1, nullptr));
    ASSERT_TRUE(terrain::build_store(grid, folder.file("three.hts"), 3, nullptr));
    EXPECT_EQ(bytes_of(folder.file("one.hts")), bytes_of(folder.file("three.hts")));
}

/// A refusal: one line that names the file and says what was expected.
void expect_refusal(const lod::Result<terrain::StoreFile>& store, const std::string& name) {
    ASSERT_FALSE(store);
    EXPECT_NE(store.message().find(name), std::string::npos) << store.message();
    EXPECT_NE(store.message().find("expected"), std::string::npos) << store.message();
    EXPECT_EQ(store.message().find('\n'), std::string::npos) << store.message();
}

TEST(StoreFile, EveryByteOfTheHeaderCounts) {
    const CutFolder folder;
    const std::string path = folder.file("a.hts");
    const terrain::StoreFile whole =
        terrain_test::build_and_open(terrain_test::geographic_grid(70, 50), path);
    for (uint64_t place = 0; place < whole.header().size_bytes(); ++place) {
        SCOPED_TRACE(place);
        const unsigned bits = 1u << (place % 8);
        flip_byte(path, place, bits);
        expect_refusal(terrain::StoreFile::open(path), path);
        flip_byte(path, place, bits);
    }
    EXPECT_TRUE(terrain::StoreFile::open(path));
}

TEST(StoreFile, AFlippedByteOfAPageIsFoundInThatPage) {
    const CutFolder folder;
    const std::string path = folder.file("a.hts");
    const terrain::StoreFile store =
        terrain_test::build_and_open(terrain_test::fractal_grid(257, 257, 10.0, 300.0, 1), path);
    lod::Rng rng(3);
    std::vector<terrain::DiamondSource> page(terrain::kPageEntries);
    for (int round = 0; round < 40; ++round) {
        const uint64_t place = rng.below(store.layout().page_count() * terrain::kPageBytes);
        const unsigned bits = 1u << rng.below(8);
        flip_byte(path, store.header().size_bytes() + place, bits);
        for (size_t i = 0; i < store.layout().page_count(); ++i) {
            const auto read = store.read_page(i, page);
            EXPECT_EQ(bool(read), i != place / terrain::kPageBytes);
            if (!read) {
                EXPECT_NE(read.message().find("page " + std::to_string(i)), std::string::npos);
            }
        }
        flip_byte(path, store.header().size_bytes() + place, bits);
    }
}

TEST(StoreFile, AnotherFileUnderItsNameChangesNothing) {
    const CutFolder folder;
    const std::string path = folder.file("a.hts");
    const data::HeightGrid grid = terrain_test::fractal_grid(257, 257, 10.0, 300.0, 1);
    const terrain::StoreFile store = terrain_test::build_and_open(grid, path);
    ASSERT_TRUE(terrain::build_store(terrain_test::fractal_grid(90, 90, 10.0, 300.0, 2), path, 2, nullptr));
    const terrain::DiamondTable whole = terrain::make_diamond_table(grid, 2);
    std::vector<terrain::DiamondSource> page(terrain::kPageEntries);
    for (size_t i = 0; i < store.layout().page_count(); ++i) {
        ASSERT_TRUE(store.read_page(i, page));
        EXPECT_EQ(std::memcmp(page.data(), &whole.slots[i * terrain::kPageEntries], terrain::kPageBytes), 0);
    }
}

TEST(StoreFile, PagesThatChangedPlacesAreFound) {
    const CutFolder folder;
    const std::string path = folder.file("a.hts");
    const terrain::StoreFile store =
        terrain_test::build_and_open(terrain_test::fractal_grid(257, 257, 10.0, 300.0, 1), path);
    std::string bytes = bytes_of(path);
    const auto at = [&](size_t page) {
        return bytes.begin() +
               static_cast<ptrdiff_t>(store.header().size_bytes() + page * terrain::kPageBytes);
    };
    std::swap_ranges(at(8), at(9), at(9));
    write_bytes(path, bytes);
    std::vector<terrain::DiamondSource> page(terrain::kPageEntries);
    EXPECT_TRUE(store.read_page(7, page));
    EXPECT_FALSE(store.read_page(8, page));
    EXPECT_FALSE(store.read_page(9, page));
}

TEST(StoreFile, CutAnywhereIsRefused) {
    const CutFolder folder;
    const std::string path = folder.file("a.hts");
    static_cast<void>(
        terrain_test::build_and_open(terrain_test::fractal_grid(130, 130, 10.0, 300.0, 1), path));
    const auto open = [&]() -> std::optional<std::string> {
        const auto store = terrain::StoreFile::open(path);
        return store ? std::nullopt : std::optional(store.message());
    };
    EXPECT_TRUE(test::cut_down(path, path, open).read_at.empty());
}

TEST(StoreFile, LongerFilesAndOtherKindsAreRefused) {
    const CutFolder folder;
    const std::string path = folder.file("a.hts");
    static_cast<void>(terrain_test::build_and_open(terrain_test::fractal_grid(20, 20, 10.0, 300.0, 1), path));
    const std::string bytes = bytes_of(path);
    write_bytes(path, bytes + "x");
    expect_refusal(terrain::StoreFile::open(path), path);
    std::string other = bytes;
    other[8] = 7;
    write_bytes(path, other);
    const auto newer = terrain::StoreFile::open(path);
    expect_refusal(newer, path);
    EXPECT_NE(newer.message().find("version 7"), std::string::npos) << newer.message();
    write_bytes(path, std::string(bytes.size(), 'x'));
    expect_refusal(terrain::StoreFile::open(path), path);
    expect_refusal(terrain::StoreFile::open(folder.file("nowhere.hts")), "nowhere.hts");
    expect_refusal(terrain::StoreFile::open(folder.file("")), "");
}

TEST(StoreFile, IsWrittenWholeOrNotAtAll) {
    const CutFolder folder;
    const data::HeightGrid grid = terrain_test::fractal_grid(20, 20, 10.0, 300.0, 1);
    EXPECT_FALSE(terrain::build_store(grid, folder.file("no/where/a.hts"), 1, nullptr));
    std::filesystem::create_directory(folder.file("taken"));
    const auto built = terrain::build_store(grid, folder.file("taken"), 1, nullptr);
    ASSERT_FALSE(built);
    EXPECT_NE(built.message().find("taken"), std::string::npos);
    size_t entries = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.file("")))
        ++entries;
    EXPECT_EQ(entries, 1u) << "something was left behind";
}

}  // namespace
