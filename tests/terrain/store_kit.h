// Stores for tests: relief with every peculiarity, built into a folder of the test's own.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "terrain/store/page_loader.h"
#include "terrain/store/store_builder.h"
#include "tests/data/cut_files.h"
#include "tests/terrain/test_relief.h"

namespace terrain_test {

/// Fractal relief around the equator or further north, in degrees.
inline data::HeightGrid geographic_grid(int width, int height) {
    data::HeightGrid grid = fractal_grid(width, height, 30.0, 900.0, 5);
    const std::array<double, 6> place = {-122.0, 1.0 / 3600, 0.0, 47.0, 0.0, -1.0 / 3600};
    grid.frame = *data::GroundFrame::make(place, "EPSG:4326", width, height);
    return grid;
}

/// A slanting coast: half of the samples are void, and an island hole.
inline data::HeightGrid half_void_grid(int width, int height) {
    data::HeightGrid grid = fractal_grid(width, height, 10.0, 300.0, 6);
    grid.is_void.assign(grid.height_m.size(), 0);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const bool is_hole = std::abs(x - width / 4) < 9 && std::abs(y - height / 4) < 5;
            if (x + y / 3 > width * 2 / 3 || is_hole) grid.is_void[grid.index(x, y)] = 1;
        }
    }
    return grid;
}

inline terrain::StoreFile build_and_open(const data::HeightGrid& grid, const std::string& path) {
    const auto built = terrain::build_store(grid, path, 2, nullptr);
    EXPECT_TRUE(built) << built.message();
    auto store = terrain::StoreFile::open(path);
    EXPECT_TRUE(store) << store.message();
    return std::move(*store);
}

/// Bytes of a loader's limit that leaves room for this many pages.
inline uint64_t room_for(size_t pages) {
    return (pages + 1) * (terrain::kPageBytes + 64);
}

/// Whether a page of a table is present and byte for byte another table's.
inline bool is_same_page(const terrain::DiamondTable& paged, const terrain::DiamondTable& whole,
                         size_t page) {
    const uint32_t slot = paged.slot_of_page[page];
    return slot != terrain::DiamondTable::kAbsent &&
           std::memcmp(&paged.slots[slot * terrain::kPageEntries], &whole.slots[page * terrain::kPageEntries],
                       terrain::kPageBytes) == 0;
}

}  // namespace terrain_test
