// The columns of a CSV recording: which one says what, in which unit.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lod/base/result.h"

namespace data {

/// What a column can say.
enum class MotionRole : uint8_t {
    kTime,
    kDate,
    kZone,
    kLongitude,
    kLatitude,
    kX,
    kY,
    kHeight,
    kHeading,
    kPitch,
    kRoll,
    kMagneticVariation,
    kCount
};

/// The column of a role.
struct MotionColumn {
    size_t index = 0;
    double si_per_unit =
        1.0;  ///< times the cell's number: seconds, metres, radians; degrees for longitude, latitude
};

/// Columns found by role.
class MotionColumns {
  public:
    /// @param names  the header's cells
    /// @param units  the unit row's cells, or empty; a unit in the name (`altitude_ft`, `Alt (ft)`) goes before it
    /// Units: m, ft, s, ms, deg, rad. Without one: metres, seconds, degrees, but `altitude` and `geoaltitude` are feet
    /// beside a `groundspeed`, as in ADS-B state vectors.
    /// Fails naming the missing column: time, place (longitude and latitude, or x and y) and height must be there.
    static lod::Result<MotionColumns> find(const std::vector<std::string>& names,
                                           const std::vector<std::string>& units);

    const std::optional<MotionColumn>& operator[](MotionRole role) const {
        return columns_[static_cast<size_t>(role)];
    }
    bool is_geographic() const { return (*this)[MotionRole::kLongitude].has_value(); }

  private:
    std::array<std::optional<MotionColumn>, static_cast<size_t>(MotionRole::kCount)> columns_;
};

}  // namespace data
