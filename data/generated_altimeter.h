// A generated altimeter: three hands over a metric dial, pressure drum, knob, glass; no texture, all geometry.
#pragma once

#include "data/polygon_mesh.h"

namespace data {

/// A metric three-pointer altimeter of about 40,000 triangles, in the mesh frame of polygon_mesh.h: dial in the
/// plane y = 0 facing -y, +z up. Nodes that are meant to move, each turning clockwise about its own +z for the
/// pilot: `needle_1000` (long, hundreds of metres), `needle_10000` (short, thousands), `needle_100000` (thin, tens
/// of thousands); the number is metres per turn. The drum `pressure_drum` reads 1013 (hPa) and stands still.
/// The same triangles on every call.
PolygonMesh generate_altimeter();

}  // namespace data
