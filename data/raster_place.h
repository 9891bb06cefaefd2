// RasterPlace: where a raster's samples lie: an affine map to its CRS, and the CRS's way to site coordinates.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <string>

#include "data/geodetic_transform.h"
#include "lod/base/result.h"

namespace data {

/// Grid coordinates (column, row; integers are samples) to CRS coordinates and back.
struct RasterAffine {
    glm::dmat2 crs_from_cells{1.0};
    glm::dmat2 cells_from_crs{1.0};
    glm::dvec2 origin{0.0};  ///< CRS position of sample (0, 0)

    glm::dvec2 crs_from_grid(const glm::dvec2& grid) const { return origin + crs_from_cells * grid; }
    glm::dvec2 grid_from_crs(const glm::dvec2& crs) const { return cells_from_crs * (crs - origin); }
};

/// Move-only.
class RasterPlace {
  public:
    /// @param geo_transform  GDAL's six numbers, from pixel corners
    /// @param crs            empty or a local CRS: sites are the raster's own x, y
    /// @param width, height  samples, >= 1; longitudes are taken to the turn around the raster's middle
    /// Fails on what cannot be inverted and on a CRS that is not understood.
    static lod::Result<RasterPlace> make(const std::array<double, 6>& geo_transform, const std::string& crs,
                                         int width, int height);

    bool has_datum() const { return transform_.kind() != CrsKind::kNone; }
    const RasterAffine& affine() const { return affine_; }

    /// CRS coordinates are WGS84 degrees as they stand, or there is no datum: PROJ is not asked.
    bool is_site_crs() const { return is_site_crs_; }

    /// In place: grid (column, row) to site (longitude, latitude or x, y). NaN where there is none. Longitudes
    /// may exceed 180. About 1 us each where PROJ is asked. Safe to call from several threads.
    void sites_from_grid(std::span<glm::dvec2> points) const;

    /// In place, the inverse; may lie outside the raster.
    void grid_from_sites(std::span<glm::dvec2> points) const;

    /// Cells in a full turn of longitude, along columns and rows; zero unless the CRS is geographic.
    glm::dvec2 full_turn_cells() const {
        return affine_.cells_from_crs * glm::dvec2(transform_.full_turn(), 0.0);
    }

  private:
    RasterPlace(const RasterAffine& affine, GeodeticTransform transform);
    bool is_wgs84_degrees(int width, int height) const;

    RasterAffine affine_;
    GeodeticTransform transform_;
    double middle_x_ = 0.0;  // CRS
    bool is_site_crs_ = true;
};

}  // namespace data
