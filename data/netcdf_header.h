// The header of a classic netCDF file, as far as it states the file's length: the library reads zeros beyond its end.
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

namespace data {

/// What is wanted of a file whose header is cut: more than any file has.
inline constexpr uint64_t kCutHeader_bytes = std::numeric_limits<uint64_t>::max();

/// Bytes up to the end of the last variable (of variables made of records, of their first); 0 when `head` does not
/// begin a classic netCDF (versions 1, 2 and 5), kCutHeader_bytes when the header itself is cut.
/// Format: "The NetCDF classic format specification", Unidata.
/// @param head  the file's beginning
uint64_t netcdf_bytes(std::string_view head);

}  // namespace data
