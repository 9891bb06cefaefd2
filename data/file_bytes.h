// Whole files as bytes, as they are or unpacked from gzip.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lod/base/result.h"

namespace data {

/// A file's content. Fails when there is none to read or more than `max_bytes`.
lod::Result<std::vector<uint8_t>> read_file(const std::string& path, size_t max_bytes);

/// The content of a gzip file. Fails when it is damaged, cut short, or larger than `max_bytes`.
lod::Result<std::vector<uint8_t>> read_gzip_file(const std::string& path, size_t max_bytes);

}  // namespace data
