#include "data/height_pyramid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lod/base/check.h"
#include "lod/base/parallel.h"

namespace data {
namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();

/// Nodes of the finest level in rows [begin, end) and columns [first, last].
void gather_samples(const HeightGrid& grid, HeightPyramid::Level& level, const SampleRange& nodes) {
    const int size = 1 << level.shift;
    for (int row = nodes.min.y; row <= nodes.max.y; ++row) {
        float* out = &level.max_m[static_cast<size_t>(row) * static_cast<size_t>(level.columns)];
        std::fill(out + nodes.min.x, out + nodes.max.x + 1, kNothing);
        const int last_y = std::min((row + 1) * size, grid.height - 1);
        for (int y = row * size; y <= last_y; ++y) {
            const float* samples = &grid.height_m[grid.index(0, y)];
            for (int col = nodes.min.x; col <= nodes.max.x; ++col) {
                const int last_x = std::min((col + 1) * size, grid.width - 1);
                float highest = out[col];
                for (int x = col * size; x <= last_x; ++x)
                    highest = std::max(highest, samples[x]);
                out[col] = highest;
            }
        }
    }
}

/// Nodes from their four children.
void gather_children(const HeightPyramid::Level& finer, HeightPyramid::Level& level,
                     const SampleRange& nodes) {
    for (int row = nodes.min.y; row <= nodes.max.y; ++row) {
        for (int col = nodes.min.x; col <= nodes.max.x; ++col) {
            float highest = kNothing;
            for (int y = 2 * row; y <= std::min(2 * row + 1, finer.rows - 1); ++y) {
                for (int x = 2 * col; x <= std::min(2 * col + 1, finer.columns - 1); ++x) {
                    highest = std::max(
                        highest, finer.max_m[static_cast<size_t>(y) * static_cast<size_t>(finer.columns) +
                                             static_cast<size_t>(x)]);
                }
            }
            level.max_m[static_cast<size_t>(row) * static_cast<size_t>(level.columns) +
                        static_cast<size_t>(col)] = highest;
        }
    }
}

/// Levels without heights.
HeightPyramid empty_pyramid(int width, int height) {
    HeightPyramid pyramid;
    pyramid.width = width;
    pyramid.height = height;
    for (int shift = HeightPyramid::kFinestShift;; ++shift) {
        HeightPyramid::Level level;
        level.shift = shift;
        level.columns = ((width - 2) >> shift) + 1;
        level.rows = ((height - 2) >> shift) + 1;
        level.max_m.resize(static_cast<size_t>(level.columns) * static_cast<size_t>(level.rows));
        pyramid.levels.push_back(std::move(level));
        if (pyramid.levels.back().max_m.size() == 1) break;
    }
    std::reverse(pyramid.levels.begin(), pyramid.levels.end());
    return pyramid;
}

/// Everything above the finest level, for its nodes in a range.
void gather_upwards(HeightPyramid& pyramid, SampleRange nodes) {
    for (size_t i = pyramid.levels.size() - 1; i-- > 0;) {
        nodes = {nodes.min / 2, nodes.max / 2};
        gather_children(pyramid.levels[i + 1], pyramid.levels[i], nodes);
    }
}

}  // namespace

HeightPyramid make_height_pyramid(const HeightGrid& grid, unsigned threads) {
    CHECK(grid.width >= 2 && grid.height >= 2);
    HeightPyramid pyramid = empty_pyramid(grid.width, grid.height);
    HeightPyramid::Level& finest = pyramid.levels.back();
    lod::parallel_for(static_cast<size_t>(finest.rows), threads, [&](size_t begin, size_t end) {
        const int first = static_cast<int>(begin), last = static_cast<int>(end) - 1;
        gather_samples(grid, finest, {{0, first}, {finest.columns - 1, last}});
    });
    gather_upwards(pyramid, {{0, 0}, {finest.columns - 1, finest.rows - 1}});
    return pyramid;
}

void update(HeightPyramid& pyramid, const HeightGrid& grid, const SampleRange& changed) {
    CHECK(pyramid.width == grid.width && pyramid.height == grid.height);
    const glm::ivec2 last(grid.width - 1, grid.height - 1);
    const glm::ivec2 min = glm::max(changed.min, glm::ivec2(0)), max = glm::min(changed.max, last);
    if (min.x > max.x || min.y > max.y) return;
    HeightPyramid::Level& finest = pyramid.levels.back();
    const int size = 1 << finest.shift;
    // A sample on the border of a node is the neighbour's, too.
    const glm::ivec2 first_node = glm::max(min - 1, glm::ivec2(0)) / size;
    const glm::ivec2 last_node = glm::min(max / size, glm::ivec2(finest.columns - 1, finest.rows - 1));
    gather_samples(grid, finest, {first_node, last_node});
    gather_upwards(pyramid, {first_node, last_node});
}

float highest_m(const HeightPyramid& pyramid, const glm::dvec2& min_grid, const glm::dvec2& max_grid) {
    const glm::dvec2 last(pyramid.width - 1, pyramid.height - 1);
    const bool is_in = max_grid.x >= 0.0 && max_grid.y >= 0.0 && min_grid.x <= last.x && min_grid.y <= last.y;
    if (!is_in) return kNothing;
    const glm::ivec2 min(glm::max(min_grid, glm::dvec2(0.0))), max(glm::min(max_grid, last));
    // The finest level whose nodes are at least as large: two each way will do.
    const int cells = std::max(max.x - min.x, max.y - min.y);
    size_t i = pyramid.levels.size() - 1;
    while (i > 0 && (1 << pyramid.levels[i].shift) < cells)
        --i;
    const HeightPyramid::Level& level = pyramid.levels[i];
    const int last_col = std::min(max.x >> level.shift, level.columns - 1);
    const int last_row = std::min(max.y >> level.shift, level.rows - 1);
    float highest = kNothing;
    for (int row = std::min(min.y >> level.shift, last_row); row <= last_row; ++row) {
        for (int col = std::min(min.x >> level.shift, last_col); col <= last_col; ++col) {
            highest =
                std::max(highest, level.max_m[static_cast<size_t>(row) * static_cast<size_t>(level.columns) +
                                              static_cast<size_t>(col)]);
        }
    }
    return highest;
}

}  // namespace data
