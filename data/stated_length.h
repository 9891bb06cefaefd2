// Whether a file that GDAL has opened is all there, by what its own format states, where GDAL itself does not ask:
// it then fills what is missing with zeros, or ends early without a word.
#pragma once

#include <gdal.h>

#include <optional>
#include <string>

namespace data {

/// What is missing, and what was expected; empty when nothing is known to be. Checked, by the driver that opened the
/// file: pages of SQLite and GeoPackage, variables of classic netCDF (of records the first), pixels of ENVI, the
/// header of a shapefile's table, and the end of the last line of CSV, GeoJSONSeq and XYZ. Text cut exactly between two lines is a smaller file, and valid.
/// Reads a few bytes; of netCDF the header, a megabyte at the most.
/// @param path  as GDAL opened it
std::optional<std::string> length_problem(GDALDatasetH dataset, const std::string& path);

}  // namespace data
