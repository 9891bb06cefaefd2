#include "data/motion_fix.h"

#include <cmath>

namespace data {

void MotionFixes::add(const MotionFix& fix) {
    const SitePoint& site = fix.site;
    bool is_usable = std::isfinite(fix.time_s) && std::isfinite(site.x) && std::isfinite(site.y) &&
                     std::isfinite(site.height_m);
    if (is_geographic) is_usable = is_usable && std::abs(site.x) <= 360.0 && std::abs(site.y) <= 90.0;
    if (!fixes.empty()) is_usable = is_usable && fix.time_s > fixes.back().time_s;
    if (is_usable) {
        fixes.push_back(fix);
    } else {
        ++dropped;
    }
}

}  // namespace data
