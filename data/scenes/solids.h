// Solids of a TimedMesh with counted triangles: boxes, beams, prisms, heaps, crowns. What generated scenes are made of.
//
// Every function appends to the mesh; faces are counter-clockwise outside; lengths in metres, object frame.
#pragma once

#include <cstdint>

#include "data/timed_scene.h"

namespace data {

/// sRGB.
using Colour = glm::u8vec3;

/// 12 triangles. `low` is below `high` in every axis.
void append_box(const glm::dvec3& low, const glm::dvec3& high, const Colour& colour, TimedMesh& mesh);

/// A bar of rectangular section along a line: 12 triangles.
/// @param width   across, level where the line is not vertical
/// @param height  across the other way
struct Bar {
    glm::dvec3 from{0.0}, to{0.0};
    double width = 0.1, height = 0.1;
};
void append_bar(const Bar& bar, const Colour& colour, TimedMesh& mesh);

/// A round bar with both ends closed, its mantle smooth: 4 * sides - 4 triangles.
struct Tube {
    glm::dvec3 from{0.0}, to{0.0};
    double radius = 0.1;
    int sides = 8;  ///< >= 3
};
void append_tube(const Tube& tube, const Colour& colour, TimedMesh& mesh);

/// A heap of sand or gravel on the plane z = 0, open below, about `height` high: exactly `triangles`, >= 9.
struct Heap {
    double radius = 1.0, height = 1.0;
    uint64_t triangles = 9;
};
void append_heap(const Heap& heap, const Colour& colour, TimedMesh& mesh);

/// A rounded lump, flattened or stretched: 80 triangles of an icosahedron divided once.
void append_lump(const glm::dvec3& centre, const glm::dvec3& half, const Colour& colour, TimedMesh& mesh);

}  // namespace data
