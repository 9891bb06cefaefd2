// GPX recordings: the points of all tracks, through OGR.
#pragma once

#include <string>

#include "data/motion_fix.h"
#include "lod/base/result.h"

namespace data {

/// Points without time or elevation are dropped and counted. Fails on what OGR does not read as GPX.
lod::Result<MotionFixes> read_motion_gpx(const std::string& path);

}  // namespace data
