// NearestFaces: which faces of a reduced soup stand for which of its source, quarter by quarter.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "objects/reduction/face_soup.h"

namespace objects {

inline constexpr uint32_t kNoFace = 0xffffffffu;

/// The points that speak for a face: the middles of the four triangles that the middles of its edges cut it into.
std::array<glm::dvec3, 4> quarters(const lod::Triangle& t);

/// [faces of source] for each of a face's quarters the nearest face of `result`; kNoFace where none is within the limit.
/// Cost: O(n log n), four searches a face.
using NearestFaces = std::vector<std::array<uint32_t, 4>>;
NearestFaces nearest_faces(const FaceSoup& source, const FaceSoup& result, double limit_m);

}  // namespace objects
