// Depth as a GeoTIFF of one float band.
#pragma once

#include <string>

#include "lod/base/result.h"
#include "render/renderer.h"

namespace sim {

/// Writes metres along the line of sight, top row first, no CRS; +infinity where nothing was drawn.
/// Fails on an unwritable path; the file appears complete or not at all.
lod::Result<lod::Ok> write_depth_tiff(const std::string& path, const render::DepthImage& depth);

}  // namespace sim
