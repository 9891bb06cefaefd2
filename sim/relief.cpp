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

std::vector<float> prominence_of(const data::HeightGrid& grid, unsigned threads) {
    const auto width = static_cast<size_t>(grid.width), height = static_cast<size_t>(grid.height);
    const glm::dvec2 cell = grid.frame.cell_m();
    const auto radius = [](double cell_m) {
        return std::clamp(static_cast<int>(kSurroundings_m / cell_m), 2, 200);
    };
    std::vector<float> rows(grid.height_m.size()), mean(grid.height_m.size());
    lod::parallel_for(height, threads, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row) {
            box_mean(&grid.height_m[row * width], &rows[row * width], grid.width, 1, radius(cell.x));
        }
    });
    lod::parallel_for(width, threads, [&](size_t begin, size_t end) {
        for (size_t col = begin; col < end; ++col)
            box_mean(&rows[col], &mean[col], grid.height, width, radius(cell.y));
    });
    for (size_t i = 0; i < mean.size(); ++i)
        mean[i] = grid.height_m[i] - mean[i];
    return mean;
}

/// Cast shadows by one sweep away from the sun, line by line: the lowest height that still sees the sun follows
/// from the line before, where the ray through the sample comes from. Lines are columns: the sun is in the east.
std::vector<uint8_t> sunlight_of(const data::HeightGrid& grid) {
    static_assert(kSunEast > kSunSouth && kSunSouth > 0.0,
                  "the sweep goes west, its rays come from the south-east");
    const glm::dvec2 cell = grid.frame.cell_m();
    const double shift = kSunSouth / kSunEast * cell.x / cell.y;  // rows per column
    const double drop_m = cell.x * kSunEnu.z / kSunEast;
    const double soft_m = 0.15 * drop_m + 1.0;
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
    return {prominence_of(grid, threads), sunlight_of(grid), shore_of(grid)};
}

}  // namespace sim
