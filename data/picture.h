// Pictures: any raster GDAL reads as 8-bit RGBA, a window at a time and no finer than asked for.
#pragma once

#include <glm/glm.hpp>

#include "data/image.h"
#include "data/raster_file.h"
#include "lod/base/result.h"

namespace data {

/// A rectangle of a raster's pixels.
struct PixelWindow {
    glm::ivec2 begin{0};  ///< column, row
    glm::ivec2 size{0};   ///< > 0, inside the raster
};

/// Reads a window as an image of `size` pixels, averaging where that is fewer (palettes: nearest).
///
/// Red, green and blue by the bands' meaning, else the first three bands; fewer bands are grey; palettes are
/// looked up. Alpha from an alpha band, else from masks and nodata: 0 where every colour band is masked. Bands
/// other than 8-bit are stretched from their smallest to their largest value.
lod::Result<Image> read_picture(const RasterFile& file, const PixelWindow& window, const glm::ivec2& size);

}  // namespace data
