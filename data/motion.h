// Recorded motion: samples of where a craft was and how it pointed, and interpolation between them.
#pragma once

#include <string>
#include <vector>

#include "data/world_frame.h"
#include "lod/base/result.h"

namespace data {

/// One fix. Angles in radians: heading clockwise from north, pitch nose up, roll right wing down.
struct MotionSample {
    double time_s = 0.0;  ///< from the first sample
    SitePoint site;
    double heading_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
};

/// Times strictly increasing; at least two samples.
struct Motion {
    std::vector<MotionSample> samples;
    bool is_geographic = true;  ///< sites are longitude and latitude, degrees; else x, y of the scene
    bool has_attitude =
        false;             ///< pitch and roll were recorded; else derived from the path (coordinated turns)
    uint64_t dropped = 0;  ///< rows without position, repeated, going back in time, or cut

    double duration_s() const { return samples.empty() ? 0.0 : samples.back().time_s; }
};

/// Reads CSV recordings with a header line (column names as of Garmin G1000 logs, ADS-B state vectors and plain
/// time,lon,lat,height,heading,pitch,roll or time,x,y,height; feet where the name or unit row says so), or GPX tracks.
/// Times are ISO 8601, clock times or seconds. Angles of the attitude that no row states are derived from the
/// path (data/motion_attitude.h).
/// Fails with file, line and expectation when a needed column is missing or fewer than two rows are usable.
lod::Result<Motion> read_motion(const std::string& path);

/// The pose at `time_s`, clamped to the ends. Passes through the samples with continuous velocity: Catmull-Rom over
/// time, its rates limited so that it neither overshoots a stop nor loops; angles and longitudes the short way round.
/// Longitudes in [-180, 180], headings in [0, 2 pi). CHECKs that there are two samples. Cost: O(log n).
MotionSample motion_at(const Motion& motion, double time_s);

}  // namespace data
