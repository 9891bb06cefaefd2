// A generated panel meter of a stated number of triangles: what level of detail is tried on.
#pragma once

#include <cstdint>

#include "data/polygon_mesh.h"

namespace data {

constexpr uint32_t kMeterTriangles = 86802;

/// A round meter with four threaded terminals behind and a ribbed damper in front of its dial: node `needle_100` turns
/// once per 100 units. All geometry, no texture.
/// @param triangles  exactly so many, at least kLeastMeterTriangles; what the other parts leave goes into the damper's
///                   ribs. CHECKs that it is enough
PolygonMesh generate_meter(uint32_t triangles = kMeterTriangles);
constexpr uint32_t kLeastMeterTriangles = 71000;

}  // namespace data
