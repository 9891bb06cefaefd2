#include "data/height_grid.h"

#include <algorithm>
#include <array>
#include <limits>

#include "data/height_raster.h"
#include "data/mosaic.h"
#include "data/voids.h"
#include "lod/base/check.h"

namespace data {

HeightGrid make_planar_grid(int width, int height, double spacing_m, std::vector<float> height_m) {
    CHECK(width >= 1 && height >= 1 && spacing_m > 0.0);
    CHECK(height_m.size() == static_cast<size_t>(width) * static_cast<size_t>(height));
    const std::array<double, 6> geo_transform = {-0.5 * spacing_m,           spacing_m, 0.0,
                                                 (height - 0.5) * spacing_m, 0.0,       -spacing_m};
    HeightGrid grid;
    grid.width = width;
    grid.height = height;
    const auto [min, max] = std::minmax_element(height_m.begin(), height_m.end());
    grid.min_m = *min;
    grid.max_m = *max;
    grid.height_m = std::move(height_m);
    grid.frame = *GroundFrame::make(geo_transform, "", width, height);
    return grid;
}

namespace {

// East and north of a step along a row, and of one along a column, in the raster's middle.
glm::dmat2 compass_from_cells(const HeightRaster& raster, const GroundFrame& frame) {
    const double col = (raster.width - 1) * 0.5, row = (raster.height - 1) * 0.5;
    const glm::dvec3 middle = frame.world_from_grid(col, row, 0.0);
    const glm::dmat3 enu_from_world = glm::transpose(frame.world().world_from_enu(middle));
    const glm::dvec3 along_row = enu_from_world * (frame.world_from_grid(col + 0.5, row, 0.0) - middle);
    const glm::dvec3 along_col = enu_from_world * (frame.world_from_grid(col, row + 0.5, 0.0) - middle);
    return {along_row.x, along_row.y, along_col.x, along_col.y};
}

// Rasters leave their files with x to the right and y up; here CRSs whose x and y count otherwise are put right.
lod::Result<GroundFrame> frame_of(HeightRaster& raster) {
    auto frame = GroundFrame::make(raster.geo_transform, raster.crs_wkt, raster.width, raster.height);
    if (!frame || !orient(raster, compass_from_cells(raster, *frame))) return frame;
    return GroundFrame::make(raster.geo_transform, raster.crs_wkt, raster.width, raster.height);
}

// Moves the raster's samples into a grid: extremes, voids, and the place in the world.
lod::Result<HeightGrid> grid_from(HeightRaster raster, VoidPolicy policy) {
    HeightGrid grid;
    grid.width = raster.width;
    grid.height = raster.height;
    float min_m = std::numeric_limits<float>::infinity(), max_m = -min_m;
    for (size_t i = 0; i < raster.height_m.size(); ++i) {
        if (raster.is_void[i]) continue;
        min_m = std::min(min_m, raster.height_m[i]);
        max_m = std::max(max_m, raster.height_m[i]);
    }
    const std::string where = "terrain '" + raster.path + "': ";
    if (min_m > max_m) return lod::Error{where + "every sample is void; expected at least one height"};
    const auto frame = frame_of(raster);
    if (!frame) return lod::Error{where + frame.message()};
    fill_voids(raster.width, raster.height, raster.height_m, raster.is_void);
    const bool has_void = std::find(raster.is_void.begin(), raster.is_void.end(), 1) != raster.is_void.end();
    grid.frame = *frame;
    grid.min_m = min_m;
    grid.max_m = max_m;
    grid.height_m = std::move(raster.height_m);
    if (has_void) (policy == VoidPolicy::kHole ? grid.is_void : grid.is_filled) = std::move(raster.is_void);
    return grid;
}

}  // namespace

lod::Result<HeightGrid> read_height_grid(const std::vector<std::string>& paths,
                                         const HeightGridOptions& options) {
    if (paths.empty()) return lod::Error{"terrain: no source is named; expected at least one raster"};
    std::vector<HeightRaster> rasters;
    for (const std::string& path : paths) {
        auto raster = read_height_raster(path, options.has_undeclared_nodata);
        if (!raster) return raster.error();
        if (raster->width < 2 || raster->height < 2) {
            return lod::Error{"terrain '" + path + "': " + std::to_string(raster->width) + " x " +
                              std::to_string(raster->height) + " samples; expected at least 2 x 2"};
        }
        rasters.push_back(std::move(*raster));
    }
    auto joined = join(std::move(rasters));
    if (!joined) return joined.error();
    return grid_from(std::move(*joined), options.voids);
}

}  // namespace data
