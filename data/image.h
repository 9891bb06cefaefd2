// Image: 8-bit RGBA pixels, row-major from the top left, and imagery draped over a height grid.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "data/height_grid.h"
#include "lod/base/result.h"

namespace data {

/// Plain pixels.
struct Image {
    int width = 0, height = 0;
    std::vector<uint8_t> rgba;  ///< [height * width * 4], sRGB, straight alpha
};

/// Imagery resampled to the extent of a height grid: pixel (0,0) covers the north-west corner sample's
/// neighbourhood; the image spans grid columns [-0.5, width - 0.5] and rows [-0.5, height - 0.5]. Alpha 0 where
/// no source covers the ground. The first listed source wins. Grey and palette pictures too; bands deeper than
/// 8 bits are stretched. Without a datum the pictures' x and y are taken as the grid's, whatever their CRS.
/// @param max_size_px  the longer side of the result; it is never finer than the finest source
/// Fails on an unreadable source; a source that does not touch the grid is an error that says both extents.
lod::Result<Image> read_imagery(const std::vector<std::string>& paths, const HeightGrid& grid,
                                int max_size_px);

}  // namespace data
