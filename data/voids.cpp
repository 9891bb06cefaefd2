#include "data/voids.h"

#include <algorithm>
#include <vector>

#include "lod/base/check.h"

namespace data {

namespace {

constexpr int kSweeps = 4;

// One resolution: the source's heights, or a quarter of the samples of the level below.
struct Level {
    int width = 0, height = 0;
    std::span<float> height_m;
    std::span<const uint8_t> is_void;

    size_t index(int col, int row) const {
        return static_cast<size_t>(row) * static_cast<size_t>(width) + static_cast<size_t>(col);
    }
    float clamped(int col, int row) const {
        return height_m[index(std::clamp(col, 0, width - 1), std::clamp(row, 0, height - 1))];
    }
};

struct Storage {
    std::vector<float> height_m;
    std::vector<uint8_t> is_void;
};

// Each coarse sample is the mean of the valid ones among its four children; void when there is none.
Level halve(const Level& fine, Storage& storage) {
    Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}, {}};
    const size_t samples = static_cast<size_t>(coarse.width) * static_cast<size_t>(coarse.height);
    storage.height_m.assign(samples, 0.0f);
    storage.is_void.assign(samples, 1);
    for (int row = 0; row < coarse.height; ++row) {
        for (int col = 0; col < coarse.width; ++col) {
            double sum = 0.0;
            int valid = 0;
            for (int y = 2 * row; y < std::min(2 * row + 2, fine.height); ++y) {
                for (int x = 2 * col; x < std::min(2 * col + 2, fine.width); ++x) {
                    if (fine.is_void[fine.index(x, y)]) continue;
                    sum += double{fine.height_m[fine.index(x, y)]};
                    ++valid;
                }
            }
            if (valid == 0) continue;
            storage.height_m[coarse.index(col, row)] = static_cast<float>(sum / valid);
            storage.is_void[coarse.index(col, row)] = 0;
        }
    }
    coarse.height_m = storage.height_m;
    coarse.is_void = storage.is_void;
    return coarse;
}

// Void samples of `fine` from the complete level above, bilinearly: each child lies a quarter off its parent.
void interpolate(const Level& coarse, const Level& fine) {
    for (int row = 0; row < fine.height; ++row) {
        const int near_row = row / 2, far_row = near_row + (row % 2 == 0 ? -1 : 1);
        for (int col = 0; col < fine.width; ++col) {
            if (!fine.is_void[fine.index(col, row)]) continue;
            const int near_col = col / 2, far_col = near_col + (col % 2 == 0 ? -1 : 1);
            const double near_m = 0.75 * double{coarse.clamped(near_col, near_row)} +
                                  0.25 * double{coarse.clamped(far_col, near_row)};
            const double far_m = 0.75 * double{coarse.clamped(near_col, far_row)} +
                                 0.25 * double{coarse.clamped(far_col, far_row)};
            fine.height_m[fine.index(col, row)] = static_cast<float>(0.75 * near_m + 0.25 * far_m);
        }
    }
}

// Void samples move to the mean of their neighbours, forwards and backwards over the level.
void relax(const Level& level) {
    const auto pull = [&](int col, int row) {
        const size_t i = level.index(col, row);
        if (!level.is_void[i]) return;
        level.height_m[i] = static_cast<float>(
            0.25 * (double{level.clamped(col - 1, row)} + double{level.clamped(col + 1, row)} +
                    double{level.clamped(col, row - 1)} + double{level.clamped(col, row + 1)}));
    };
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        for (int k = 0; k < level.height; ++k) {
            const int row = sweep % 2 == 0 ? k : level.height - 1 - k;
            for (int col = 0; col < level.width; ++col)
                pull(col, row);
        }
    }
}

}  // namespace

void fill_voids(int width, int height, std::span<float> height_m, std::span<const uint8_t> is_void) {
    CHECK(height_m.size() == is_void.size());
    CHECK(height_m.size() == static_cast<size_t>(width) * static_cast<size_t>(height));
    const auto has_void = [](const Level& level) {
        return std::find(level.is_void.begin(), level.is_void.end(), 1) != level.is_void.end();
    };
    std::vector<Level> levels{{width, height, height_m, is_void}};
    std::vector<Storage> storage(32);  // halvings of an int; spans into it must stay
    while (has_void(levels.back())) {
        if (levels.back().height_m.size() == 1) return;  // nothing valid anywhere
        levels.push_back(halve(levels.back(), storage[levels.size() - 1]));
    }
    for (size_t level = levels.size() - 1; level > 0; --level) {
        interpolate(levels[level], levels[level - 1]);
        relax(levels[level - 1]);
    }
}

}  // namespace data
