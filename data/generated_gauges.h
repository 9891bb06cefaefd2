// More generated instruments from the same parts as the altimeter, and the panel they are screwed to.
#pragma once

#include "data/polygon_mesh.h"

namespace data {

/// Airspeed in metres per second, 0 at twelve o'clock; node `needle_200` turns once per 200 m/s.
PolygonMesh generate_airspeed_indicator();

/// Heading under a fixed aeroplane; node `card_-360` turns once per 360 degrees, counter-clockwise.
PolygonMesh generate_heading_indicator();

/// A dark panel with three round openings, kPanelPitchM apart, for gauges in its plane; the middle one is at the
/// mesh's origin.
constexpr double kPanelPitchM = 0.108;
PolygonMesh generate_panel();

}  // namespace data
