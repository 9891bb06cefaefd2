// A recording as it was read: fixes in order, before attitude is completed.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "data/world_frame.h"

namespace data {

/// One row. NaN: the row does not say.
struct MotionFix {
    double time_s = 0.0;  ///< from any epoch
    SitePoint site;
    double heading_rad = std::numeric_limits<double>::quiet_NaN();
    double pitch_rad = std::numeric_limits<double>::quiet_NaN();
    double roll_rad = std::numeric_limits<double>::quiet_NaN();
};

/// Fixes with strictly increasing times.
struct MotionFixes {
    std::vector<MotionFix> fixes;
    bool is_geographic = true;  ///< sites are longitude and latitude
    uint64_t dropped = 0;       ///< rows that did not make a fix

    /// Keeps the fix when its place is usable and its time later than the last one's, else counts it.
    void add(const MotionFix& fix);
};

}  // namespace data
