// HeightRaster: one source of heights as read from its file: metres, voids marked, rows going south.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "lod/base/result.h"

namespace data {

/// Plain data. Heights of void samples are 0.
struct HeightRaster {
    std::string path;
    int width = 0, height = 0;     ///< samples
    std::vector<float> height_m;   ///< [height * width], row-major
    std::vector<uint8_t> is_void;  ///< [height * width], always present
    std::array<double, 6> geo_transform{};
    std::string crs_wkt;  ///< empty: none

    size_t index(int col, int row) const {
        return static_cast<size_t>(row) * static_cast<size_t>(width) + static_cast<size_t>(col);
    }
};

/// Reads the first band of a raster; the rules are those of read_height_grid (height_grid.h). Columns run with +x
/// and rows with -y of the CRS, as near as the raster's rotation allows.
/// Reads by rows: memory is what the result takes, and a broken file ends early.
lod::Result<HeightRaster> read_height_raster(const std::string& path, bool has_undeclared_nodata);

/// Turns and mirrors rows and columns until columns run east and rows south, as near as quarter turns allow.
/// Samples keep their places.
/// @param compass_from_cells  columns: (east, north) of a step along a row, and of one along a column
/// @returns whether anything was changed
bool orient(HeightRaster& raster, const glm::dmat2& compass_from_cells);

}  // namespace data
