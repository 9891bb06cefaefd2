// GeodeticTransform: a coordinate reference system's x, y to WGS84 longitude, latitude and back, by PROJ.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>

#include "lod/base/result.h"

namespace data {

/// What a raster's CRS says about its place.
enum class CrsKind : uint8_t {
    kNone,        ///< no CRS, or a local one: x and y are just that
    kGeographic,  ///< longitude and latitude of some datum, in some unit
    kProjected
};

/// Move-only. Coordinates are in traditional GIS order (x or longitude first); a vertical part is ignored.
/// Safe to call from several threads; they take turns.
class GeodeticTransform {
  public:
    /// @param crs  WKT, or anything GDAL accepts as a CRS; empty: kNone
    /// Fails on what GDAL does not understand and on CRSs without a horizontal part.
    static lod::Result<GeodeticTransform> make(const std::string& crs);
    GeodeticTransform(GeodeticTransform&&) noexcept;
    GeodeticTransform& operator=(GeodeticTransform&&) noexcept;
    ~GeodeticTransform();

    CrsKind kind() const;

    /// A full turn of longitude in the CRS's unit, 360 for degrees; 0 unless kind() is kGeographic.
    double full_turn() const;

    /// In place; points without a counterpart become NaN. About 1 us each. CHECKs that kind() is not kNone.
    void degrees_from_crs(std::span<glm::dvec2> points) const;
    void crs_from_degrees(std::span<glm::dvec2> points) const;

  private:
    struct State;
    explicit GeodeticTransform(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace data
