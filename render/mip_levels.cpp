#include "render/mip_levels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace render {
namespace {

/// Which texels of the finer level a texel stands for along one axis, and by which share: two, or three where an odd
/// size was rounded down.
struct Taps {
    int first = 0, count = 1;
    std::array<float, 3> share{1.0f, 0.0f, 0.0f};
};

Taps taps_of(int texel, int size, int finer_size) {
    if (finer_size == size) return {texel, 1, {1.0f, 0.0f, 0.0f}};
    if (finer_size == 2 * size) return {2 * texel, 2, {0.5f, 0.5f, 0.0f}};
    const float whole = static_cast<float>(finer_size);
    return {2 * texel,
            3,
            {static_cast<float>(size - texel) / whole, static_cast<float>(size) / whole,
             static_cast<float>(texel + 1) / whole}};
}

/// Texels [begin, end) of a level along one axis that stand for some of [first, last] of the finer one.
struct Reach {
    int begin = 0, end = 0;
};
Reach reach_of(int first, int last, int size, int finer_size) {
    const int back = finer_size == 2 * size ? 1 : 2;
    if (finer_size == size) return {first, last + 1};
    return {std::max((first - back + 1) / 2, 0), std::min(last / 2 + 1, size)};
}

void fill_texels(const MipLevel& finer, MipLevel& level, const TexelPatch& rect) {
    for (int y = rect.y; y < rect.y + rect.height; ++y) {
        const Taps rows = taps_of(y, level.height, finer.height);
        for (int x = rect.x; x < rect.x + rect.width; ++x) {
            const Taps cols = taps_of(x, level.width, finer.width);
            std::array<float, 4> sum{};
            for (int j = 0; j < rows.count; ++j) {
                const size_t row = static_cast<size_t>(rows.first + j) * static_cast<size_t>(finer.width);
                for (int i = 0; i < cols.count; ++i) {
                    const float share =
                        rows.share[static_cast<size_t>(j)] * cols.share[static_cast<size_t>(i)];
                    const uint8_t* texel = &finer.rgba[(row + static_cast<size_t>(cols.first + i)) * 4];
                    for (size_t c = 0; c < 4; ++c)
                        sum[c] += share * static_cast<float>(texel[c]);
                }
            }
            uint8_t* out = &level.rgba[(static_cast<size_t>(y) * static_cast<size_t>(level.width) +
                                        static_cast<size_t>(x)) *
                                       4];
            for (size_t c = 0; c < 4; ++c)
                out[c] = static_cast<uint8_t>(std::min(sum[c] + 0.5f, 255.0f));
        }
    }
}

TexelPatch texels_of(const MipLevel& level, TexelPatch rect) {
    rect.rgba.clear();
    for (int y = rect.y; y < rect.y + rect.height; ++y) {
        const auto first = level.rgba.begin() + (static_cast<ptrdiff_t>(y) * level.width + rect.x) * 4;
        rect.rgba.insert(rect.rgba.end(), first, first + 4 * rect.width);
    }
    return rect;
}

/// The next level's rectangle that stands for some of this one's.
TexelPatch above(const TexelPatch& rect, const MipLevel& finer, const MipLevel& level) {
    const Reach cols = reach_of(rect.x, rect.x + rect.width - 1, level.width, finer.width);
    const Reach rows = reach_of(rect.y, rect.y + rect.height - 1, level.height, finer.height);
    return {rect.level + 1, cols.begin, rows.begin, cols.end - cols.begin, rows.end - rows.begin, {}};
}

MipLevel half_of(int width, int height) {
    MipLevel level;
    level.width = std::max(width / 2, 1);
    level.height = std::max(height / 2, 1);
    level.rgba.resize(static_cast<size_t>(level.width) * static_cast<size_t>(level.height) * 4);
    return level;
}

}  // namespace

std::vector<MipLevel> make_mip_levels(int width, int height, std::span<const uint8_t> rgba) {
    std::vector<MipLevel> levels;
    MipLevel full{width, height, {rgba.begin(), rgba.end()}};
    const MipLevel* finer = &full;
    while (finer->width > 1 || finer->height > 1) {
        MipLevel level = half_of(finer->width, finer->height);
        fill_texels(*finer, level, {0, 0, 0, level.width, level.height, {}});
        levels.push_back(std::move(level));
        finer = &levels.back();
    }
    return levels;
}

std::vector<TexelPatch> update_mip_levels(MippedPicture& picture, const TexelPatch& rect) {
    std::vector<TexelPatch> patches;
    patches.push_back(texels_of(picture.full, rect));
    const MipLevel* finer = &picture.full;
    for (MipLevel& level : picture.smaller) {
        const TexelPatch next = above(patches.back(), *finer, level);
        fill_texels(*finer, level, next);
        patches.push_back(texels_of(level, next));
        finer = &level;
    }
    return patches;
}

}  // namespace render
