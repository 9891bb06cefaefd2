// The units heights come in, by the names files give them.
#pragma once

#include <string>

namespace data {

/// @param unit  as a raster's band names it: "m", "metre", "ft", "US survey foot", ..., any case
/// @returns metres per unit; 0 when it is no unit of length that is known here
double metres_per_unit(const std::string& unit);

/// The unit of a compound or three-dimensional CRS's vertical axis; 1 when it has none.
double metres_per_vertical_unit(const std::string& crs_wkt);

}  // namespace data
