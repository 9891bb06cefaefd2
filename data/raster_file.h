// RasterFile: an opened raster of any kind GDAL reads, and what it says about its place.
#pragma once

#include <array>
#include <string>

#include "data/gdal_border.h"
#include "lod/base/result.h"

namespace data {

/// Move-only; the dataset closes with it.
struct RasterFile {
    std::string path;  ///< as the user gave it
    DatasetPtr dataset;
    int width = 0, height = 0;  ///< pixels, >= 1
    bool has_place =
        false;  ///< false: no geotransform; then geo_transform is one unit a pixel, rows going south
    std::array<double, 6> geo_transform{};
    std::string crs_wkt;  ///< empty: none, or no place

    GDALRasterBandH band(int number) const { return GDALGetRasterBand(dataset.get(), number); }
    int band_count() const { return GDALGetRasterCount(dataset.get()); }
};

/// Opens `path`; `what` names it in messages ("terrain", "imagery"). A .zip or .gz is opened in place: the first
/// raster inside. Ground control points that fit an affine map exactly serve as a geotransform.
/// Fails with one line when nothing GDAL knows is there.
lod::Result<RasterFile> open_raster(const std::string& path, const std::string& what);

}  // namespace data
