#include "sim/site_metres.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sim {

glm::dvec2 metres_per_unit(const data::WorldFrame& frame, const data::SitePoint& site) {
    if (!frame.has_datum) return {1.0, 1.0};
    constexpr double kEquatorial_m = 6378137.0, kFlattening = 1.0 / 298.257223563;
    constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);
    constexpr double kRadPerDeg = std::numbers::pi / 180.0;
    const double sine = std::sin(site.y * kRadPerDeg);
    const double w = std::sqrt(1.0 - kEccentricity2 * sine * sine);
    const double cosine =
        std::max(std::cos(site.y * kRadPerDeg), 1e-6);  // at a pole any step east stays there
    return {kEquatorial_m / w * cosine * kRadPerDeg,
            kEquatorial_m * (1.0 - kEccentricity2) / (w * w * w) * kRadPerDeg};
}

data::SitePoint moved(const data::WorldFrame& frame, const data::SitePoint& site,
                      const glm::dvec2& east_north_m) {
    const glm::dvec2 unit = metres_per_unit(frame, site);
    data::SitePoint out{site.x + east_north_m.x / unit.x, site.y + east_north_m.y / unit.y, site.height_m};
    if (frame.has_datum) out.x = std::remainder(out.x, 360.0);
    return out;
}

}  // namespace sim
