// MipLevels: a picture at half, a quarter, … of its size, each texel the mean of the area it stands for.
//
// Made here and not by the driver, so that a part of the picture can be replaced on every level, and put back, without
// making the rest anew; and so that every machine shows the same.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace render {

/// A rectangle of one level's texels.
struct TexelPatch {
    int level = 0;  ///< 0: full size
    int x = 0, y = 0, width = 0, height = 0;
    std::vector<uint8_t> rgba;  ///< [height * width * 4], row-major; may be empty where only the place counts
};

struct MipLevel {
    int width = 0, height = 0;
    std::vector<uint8_t> rgba;  ///< [height * width * 4]
};

/// From half the size down to 1 x 1; odd sizes are rounded down. Empty for a single texel.
/// Cost: about 3 ns per texel of the picture.
std::vector<MipLevel> make_mip_levels(int width, int height, std::span<const uint8_t> rgba);

/// A picture and its levels.
struct MippedPicture {
    MipLevel full;
    std::vector<MipLevel> smaller;
};

/// Takes changed texels of the full picture over to the smaller levels.
/// @param rect  of `full`, level 0
/// @returns what may have changed, with its texels, one patch a level, level 0 first
/// Cost: O(texels of the rectangle + levels).
std::vector<TexelPatch> update_mip_levels(MippedPicture& picture, const TexelPatch& rect);

}  // namespace render
