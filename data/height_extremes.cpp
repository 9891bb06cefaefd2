#include "data/height_extremes.h"

#include <algorithm>
#include <limits>

#include "lod/base/check.h"
#include "lod/base/parallel.h"

namespace data {
namespace {

constexpr HeightExtremes::Block kNothing{std::numeric_limits<float>::infinity(),
                                         -std::numeric_limits<float>::infinity(), false, false};

HeightExtremes::Block of_samples(const HeightGrid& grid, const SampleRange& samples) {
    HeightExtremes::Block block = kNothing;
    for (int y = samples.min.y; y <= samples.max.y; ++y) {
        const float* row = &grid.height_m[grid.index(0, y)];
        for (int x = samples.min.x; x <= samples.max.x; ++x) {
            block.min_m = std::min(block.min_m, row[x]);
            block.max_m = std::max(block.max_m, row[x]);
        }
    }
    block.any_valid = true;
    if (!grid.has_voids()) return block;
    block.any_valid = false;
    for (int y = samples.min.y; y <= samples.max.y; ++y) {
        for (int x = samples.min.x; x <= samples.max.x; ++x)
            (grid.void_at(x, y) ? block.any_void : block.any_valid) = true;
    }
    return block;
}

void gather_samples(const HeightGrid& grid, HeightExtremes::Level& level, const SampleRange& blocks) {
    for (int row = blocks.min.y; row <= blocks.max.y; ++row) {
        for (int col = blocks.min.x; col <= blocks.max.x; ++col) {
            const glm::ivec2 first = glm::ivec2(col, row) << level.shift;
            const SampleRange samples{first, first + ((1 << level.shift) - 1)};
            level.blocks[level.index(col, row)] = of_samples(grid, common(samples, range_of(grid)));
        }
    }
}

HeightExtremes::Block of_children(const HeightExtremes::Level& finer, int col, int row) {
    HeightExtremes::Block block = kNothing;
    for (int y = 2 * row; y <= std::min(2 * row + 1, finer.rows - 1); ++y) {
        for (int x = 2 * col; x <= std::min(2 * col + 1, finer.columns - 1); ++x) {
            const HeightExtremes::Block& child = finer.blocks[finer.index(x, y)];
            block.min_m = std::min(block.min_m, child.min_m);
            block.max_m = std::max(block.max_m, child.max_m);
            block.any_valid |= child.any_valid;
            block.any_void |= child.any_void;
        }
    }
    return block;
}

/// Everything above the finest level, over its blocks in a range.
void gather_upwards(HeightExtremes& extremes, SampleRange blocks) {
    for (size_t i = extremes.levels.size() - 1; i-- > 0;) {
        HeightExtremes::Level& level = extremes.levels[i];
        blocks = {blocks.min / 2, blocks.max / 2};
        for (int row = blocks.min.y; row <= blocks.max.y; ++row) {
            for (int col = blocks.min.x; col <= blocks.max.x; ++col)
                level.blocks[level.index(col, row)] = of_children(extremes.levels[i + 1], col, row);
        }
    }
}

HeightExtremes empty_levels(int width, int height) {
    HeightExtremes extremes;
    for (int shift = HeightExtremes::kFinestShift;; ++shift) {
        HeightExtremes::Level level;
        level.shift = shift;
        level.columns = ((width - 1) >> shift) + 1;
        level.rows = ((height - 1) >> shift) + 1;
        level.blocks.resize(static_cast<size_t>(level.columns) * static_cast<size_t>(level.rows));
        extremes.levels.push_back(std::move(level));
        if (extremes.levels.back().blocks.size() == 1) break;
    }
    std::reverse(extremes.levels.begin(), extremes.levels.end());
    return extremes;
}

}  // namespace

HeightExtremes make_height_extremes(const HeightGrid& grid, unsigned threads) {
    CHECK(grid.width >= 1 && grid.height >= 1);
    HeightExtremes extremes = empty_levels(grid.width, grid.height);
    HeightExtremes::Level& finest = extremes.levels.back();
    lod::parallel_for(static_cast<size_t>(finest.rows), threads, [&](size_t begin, size_t end) {
        const int first = static_cast<int>(begin), last = static_cast<int>(end) - 1;
        gather_samples(grid, finest, {{0, first}, {finest.columns - 1, last}});
    });
    gather_upwards(extremes, {{0, 0}, {finest.columns - 1, finest.rows - 1}});
    return extremes;
}

void update(HeightExtremes& extremes, const HeightGrid& grid, const SampleRange& changed) {
    if (changed.is_empty()) return;
    HeightExtremes::Level& finest = extremes.levels.back();
    const SampleRange blocks{changed.min >> finest.shift, changed.max >> finest.shift};
    gather_samples(grid, finest, blocks);
    gather_upwards(extremes, blocks);
}

}  // namespace data
