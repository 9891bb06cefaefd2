// GroundFrame: where the samples of a raster lie in the world.
//
//   grid   column (east-ish, fractional), row (south-ish); integer values are samples (pixel centres)
//   site   longitude/latitude degrees, or the raster's own x/y when it has no usable CRS
//   world  ECEF metres, or x, y, height
//
// world_from_sample is the hot one: the level-of-detail front calls it for every vertex it creates, so it uses
// tables instead of trigonometry and PROJ: per row and column for geographic rasters (exact), second-order
// patches for projected ones.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "data/world_frame.h"
#include "lod/base/result.h"

namespace data {

/// Immutable after construction; copying is cheap (tables are shared).
class GroundFrame {
  public:
    /// @param geo_transform  GDAL's six numbers, from pixel *corners* to CRS coordinates; sample (c, r) lies at
    ///                       (c + 0.5, r + 0.5). Must be invertible.
    /// @param crs_wkt        empty: planar, world = (x, y, height). A geographic or projected CRS in any unit
    ///                       or axis order GDAL knows; other datums are taken to WGS84.
    /// @param width, height  samples, both >= 1
    /// Fails when the CRS cannot be understood or some sample has no place on the Earth.
    static lod::Result<GroundFrame> make(const std::array<double, 6>& geo_transform,
                                         const std::string& crs_wkt, int width, int height);

    const WorldFrame& world() const { return world_; }

    /// World position of sample (col, row) at a height above the ellipsoid. 0 <= col < width, 0 <= row < height.
    /// Exact (1e-8 m) for planar and geographic rasters, within 1 mm for projected ones (ground_frame_test).
    /// Cost: about 5 ns geographic, 20 ns projected (GroundFrame.IsFast). Never allocates.
    glm::dvec3 world_from_sample(int col, int row, double height_m) const;

    /// The same for fractional positions, by the full transformation; slow (about 1 us). May lie outside the raster.
    glm::dvec3 world_from_grid(double col, double row, double height_m) const;

    /// Grid position (column, row) of a site; may lie outside the raster. NaN when it has none.
    glm::dvec2 grid_from_site(const SitePoint& site) const;
    /// Column, row and height of world points, in place: the foot on the vertical and the height above it.
    /// Cost: 0.3 us each, and PROJ's 1 us where it is asked. Safe to call from several threads.
    void grid_from_world(std::span<glm::dvec3> points) const;
    /// The same of sites; points of the plane take x and y, the height stays.
    void grid_from_sites(std::span<glm::dvec3> points) const;
    /// The step in the grid that a full turn of longitude makes: places this far apart are the same. Zero where
    /// there is no such step.
    glm::dvec2 full_turn_cells() const;
    /// Site of a grid position at height 0.
    SitePoint site_from_grid(double col, double row) const;

    /// What it was made from: make() with the same gives the same frame.
    const std::array<double, 6>& geo_transform() const;
    const std::string& crs_wkt() const;

    /// Metres between neighbouring samples at the raster's middle: along a row, along a column.
    glm::dvec2 cell_m() const { return cell_m_; }

    /// How far straight chords leave the mapped grid: for any segment of n cells length (Euclidean, in cells)
    /// the linear interpolation of world positions at constant height differs from the true one by at most
    /// n^2 * up_m vertically and n^2 * side_m horizontally. Zero for planar rasters. Safe bounds, heights up to
    /// 12 km included.
    struct ChordError {
        double up_m = 0.0;
        double side_m = 0.0;
    };
    ChordError chord_error_per_cell2() const { return chord_error_; }

  private:
    struct Tables;
    WorldFrame world_;
    glm::dvec2 cell_m_{1.0};
    ChordError chord_error_;
    std::shared_ptr<const Tables> tables_;
};

}  // namespace data
