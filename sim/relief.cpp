#include "sim/relief.h"

#include <algorithm>
#include <cmath>

#include "lod/base/parallel.h"
#include "sim/sunlight.h"

namespace sim {
namespace {

constexpr double kSurroundings_m = 600.0;  // half width of the mean
constexpr uint8_t kLand = 255;

/// Means over windows of 2 * radius + 1 entries, clipped at the ends; `stride` between entries.
void box_mean(const float* in, float* out, int count, size_t stride, int radius) {
    double sum = 0.0;
    int begin = 0, end = 0;
    for (int i = 0; i < count; ++i) {
        for (; end < std::min(count, i + radius + 1); ++end)
            sum += static_cast<double>(in[static_cast<size_t>(end) * stride]);
        for (; begin < i - radius; ++begin)
            sum -= static_cast<double>(in[static_cast<size_t>(begin) * stride]);
        out[static_cast<size_t>(i) * stride] = static_cast<float>(sum / (end - begin));
    }
}

/// Half width of the mean in cells.
int mean_radius(double cell_m) {
    return std::clamp(static_cast<int>(kSurroundings_m / cell_m), 2, 200);
}

std::vector<float> prominence_of(const data::HeightGrid& grid, unsigned threads) {
    const auto width = static_cast<size_t>(grid.width), height = static_cast<size_t>(grid.height);
    const glm::dvec2 cell = grid.frame.cell_m();
    std::vector<float> rows(grid.height_m.size()), mean(grid.height_m.size());
    lod::parallel_for(height, threads, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row) {
            box_mean(&grid.height_m[row * width], &rows[row * width], grid.width, 1, mean_radius(cell.x));
        }
    });
    lod::parallel_for(width, threads, [&](size_t begin, size_t end) {
        for (size_t col = begin; col < end; ++col)
            box_mean(&rows[col], &mean[col], grid.height, width, mean_radius(cell.y));
    });
    for (size_t i = 0; i < mean.size(); ++i)
        mean[i] = grid.height_m[i] - mean[i];
    return mean;
}

/// How a ray of sun goes on from column to column, westward.
struct SunRay {
    double shift = 0.0;   ///< rows north
    double drop_m = 0.0;  ///< down
    double soft_m = 0.0;  ///< width of the shadow's edge, in height
};
SunRay sun_ray(const data::HeightGrid& grid) {
    const glm::dvec2 cell = grid.frame.cell_m();
    const double drop_m = cell.x * kSunEnu.z / kSunEast;
    return {kSunSouth / kSunEast * cell.x / cell.y, drop_m, 0.15 * drop_m + 1.0};
}

/// Cast shadows by one sweep away from the sun, line by line: the lowest height that still sees the sun follows
/// from the line before, where the ray through the sample comes from. Lines are columns: the sun is in the east.
std::vector<uint8_t> sunlight_of(const data::HeightGrid& grid) {
    static_assert(kSunEast > kSunSouth && kSunSouth > 0.0,
                  "the sweep goes west, its rays come from the south-east");
    const auto [shift, drop_m, soft_m] = sun_ray(grid);
    std::vector<uint8_t> sunlight(grid.height_m.size(), 255);
    const auto last = static_cast<size_t>(grid.height - 1);
    std::vector<double> ray(last + 1, -1e9), next(last + 1);
    for (int col = grid.width - 1; col >= 0; --col) {
        for (size_t row = 0; row <= last; ++row) {
            const size_t index = grid.index(col, static_cast<int>(row));
            const double height = static_cast<double>(grid.height_m[index]);
            const double from = std::min(static_cast<double>(row) + shift, static_cast<double>(last));
            const auto near = static_cast<size_t>(from);
            const double part = from - static_cast<double>(near);
            const double limit = glm::mix(ray[near], ray[std::min(near + 1, last)], part) - drop_m;
            const double seen = std::clamp(1.0 - (limit - height) / soft_m, 0.0, 1.0);
            sunlight[index] = static_cast<uint8_t>(std::lround(255.0 * seen));
            next[row] = std::max(limit, height);
        }
        ray.swap(next);
    }
    return sunlight;
}

/// Chamfer distance to land: one sweep from each corner. Empty when there is no sea.
std::vector<uint8_t> shore_of(const data::HeightGrid& grid) {
    std::vector<uint8_t> cells(grid.height_m.size(), kLand);
    bool any = false;
    for (int row = 0; row < grid.height; ++row) {
        for (int col = 0; col < grid.width; ++col) {
            if (!is_sea(grid, col, row)) continue;
            cells[grid.index(col, row)] = 254;
            any = true;
        }
    }
    if (!any) return {};
    const auto visit = [&](int col, int row, int step) {
        uint8_t& here = cells[grid.index(col, row)];
        if (here == kLand) return;
        const auto reach = [&](int c, int r) {
            if (c < 0 || r < 0 || c >= grid.width || r >= grid.height) return;
            const uint8_t there = cells[grid.index(c, r)];
            const int distance = there == kLand ? 1 : there + 1;
            here = static_cast<uint8_t>(std::min<int>(here, distance));
        };
        reach(col - step, row);
        reach(col, row - step);
    };
    for (int row = 0; row < grid.height; ++row) {
        for (int col = 0; col < grid.width; ++col)
            visit(col, row, 1);
    }
    for (int row = grid.height - 1; row >= 0; --row) {
        for (int col = grid.width - 1; col >= 0; --col)
            visit(col, row, -1);
    }
    return cells;
}

/// A range's samples as a grid of their own; its place in the world is not that of the range.
data::HeightGrid cut_out(const data::HeightGrid& grid, const data::SampleRange& range) {
    data::HeightGrid part;
    part.width = range.columns();
    part.height = range.rows();
    part.frame = grid.frame;
    part.height_m.reserve(range.count());
    for (int row = range.min.y; row <= range.max.y; ++row) {
        const auto first = grid.height_m.begin() + static_cast<ptrdiff_t>(grid.index(range.min.x, row));
        part.height_m.insert(part.height_m.end(), first, first + part.width);
    }
    return part;
}

/// What bears on a range: see measure_relief.
data::SampleRange bearing_on(const data::HeightGrid& grid, const data::SampleRange& range) {
    constexpr int kSeaReach = 254;
    const glm::dvec2 cell = grid.frame.cell_m();
    const glm::ivec2 mean(mean_radius(cell.x), mean_radius(cell.y));
    float lowest_m = grid.max_m;
    bool is_low = false;
    for (int row = range.min.y; row <= range.max.y; ++row) {
        for (int col = range.min.x; col <= range.max.x; ++col) {
            lowest_m = std::min(lowest_m, grid.at(col, row));
            is_low |= grid.at(col, row) <= 0.0f;
        }
    }
    const glm::ivec2 sun = shadow_reach(grid, double(grid.max_m) - double(lowest_m));
    const int sea = is_low ? kSeaReach : 1;
    const data::SampleRange wide{range.min - glm::max(mean, glm::ivec2(sea)),
                                 range.max + glm::max(glm::max(mean, sun), glm::ivec2(sea))};
    return data::common(wide, data::range_of(grid));
}

template <typename Value>
std::vector<Value> part_of(const std::vector<Value>& values, const data::SampleRange& all,
                           const data::SampleRange& part) {
    std::vector<Value> out;
    if (values.empty()) return out;
    out.reserve(part.count());
    for (int row = part.min.y; row <= part.max.y; ++row) {
        const auto first = values.begin() + static_cast<ptrdiff_t>(row - all.min.y) * all.columns() +
                           (part.min.x - all.min.x);
        out.insert(out.end(), first, first + part.columns());
    }
    return out;
}

}  // namespace

bool is_sea(const data::HeightGrid& grid, int col, int row) {
    const float height = grid.at(col, row);
    if (height > 0.0f) return false;
    const auto same = [&](int c, int r) {
        return grid.at(std::clamp(c, 0, grid.width - 1), std::clamp(r, 0, grid.height - 1)) == height;
    };
    return same(col - 1, row) && same(col + 1, row) && same(col, row - 1) && same(col, row + 1);
}

Relief measure_relief(const data::HeightGrid& grid, unsigned threads) {
    return {data::range_of(grid), prominence_of(grid, threads), sunlight_of(grid), shore_of(grid)};
}

Relief measure_relief(const data::HeightGrid& grid, const data::SampleRange& range, unsigned threads) {
    const data::SampleRange wide = bearing_on(grid, range);
    const Relief all = measure_relief(cut_out(grid, wide), threads);
    return {range, part_of(all.prominence_m, wide, range), part_of(all.sunlight, wide, range),
            part_of(all.shore, wide, range)};
}

glm::ivec2 shadow_reach(const data::HeightGrid& grid, double rise_m) {
    const SunRay ray = sun_ray(grid);
    const double cells = std::min((std::max(rise_m, 0.0) + ray.soft_m) / ray.drop_m + 1.0, 1e5);
    return {static_cast<int>(std::ceil(cells)), static_cast<int>(std::ceil(cells * ray.shift)) + 1};
}

}  // namespace sim
