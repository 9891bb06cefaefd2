// How far a triangle of ground is seen to move when one of its corners does: tight where a sphere around it is not,
// beneath the eye and at the picture's edge.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "lod/sight_metric.h"

namespace terrain {

/// Pixels by which any point of a triangle moves in any picture, at most, when its first corner moves and the other
/// two stay; a point must be in the picture before or after. A point's way falls in a straight line from the corner to
/// nothing at the far side, and so do way and depth over the part in view, a convex polygon: their ratio is largest at
/// one of its corners.
/// @param corners  relative to the eyes' anchor, metres; after the movement
/// @param way_m    of the first corner
/// Cost: about 200 ns an eye.
double corner_shift_px(std::span<const lod::AnchoredEye> eyes, const std::array<glm::vec3, 3>& corners,
                       const glm::vec3& way_m);

}  // namespace terrain
