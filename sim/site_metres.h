// Small steps on the ground: metres east and north to differences of site coordinates, and back.
#pragma once

#include <glm/glm.hpp>

#include "data/world_frame.h"

namespace sim {

/// Metres east per unit of site x and metres north per unit of site y, at `site` and height 0 of the datum.
/// With a datum: the radii of curvature of the WGS84 ellipsoid; without: 1 and 1.
glm::dvec2 metres_per_unit(const data::WorldFrame& frame, const data::SitePoint& site);

/// `site` moved by some metres east and north; good for steps of a few kilometres. Longitude stays in [-180, 180].
data::SitePoint moved(const data::WorldFrame& frame, const data::SitePoint& site,
                      const glm::dvec2& east_north_m);

}  // namespace sim
