// Where a face for two may begin, by their six corners.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "lod/surface/triangle.h"

namespace objects {

/// The largest that three of them make up.
lod::Triangle largest_face(const std::array<glm::dvec3, 6>& corners);

/// Between the two that are farthest apart, half as broad as they all are.
lod::Triangle narrow_face(const std::array<glm::dvec3, 6>& corners);

}  // namespace objects
