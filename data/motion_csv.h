// CSV recordings: lines to fixes.
#pragma once

#include <string>
#include <string_view>

#include "data/motion_fix.h"
#include "lod/base/result.h"

namespace data {

/// The first line that is neither blank nor a comment (#) is the header; a comment just above it may state units.
/// Cells are separated by comma, semicolon or tab, whichever the header has most of; they may be quoted. Garmin's
/// magnetic headings become true ones where the row states the variation. A last line without an end may have lost
/// digits: it is dropped, and counted. Lines cut off whole do not show.
/// @param content  the whole file
/// @param path     for the message
lod::Result<MotionFixes> read_motion_csv(std::string_view content, const std::string& path);

}  // namespace data
