// Outline: plane shapes with holes, made from strokes and cut-outs and triangulated, by GEOS.
//
// The raw material of generated instruments: digits are strokes of some width, dials are discs with windows.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace data {

/// One connected area. Rings are open; the outer is counter-clockwise, holes clockwise.
struct Outline {
    std::vector<std::vector<glm::dvec2>> rings;      ///< [0] outer, [1..] holes
    std::vector<std::array<uint32_t, 3>> triangles;  ///< into the rings' points in order; counter-clockwise
};

/// Any number of separate areas.
using Shape = std::vector<Outline>;
using Polyline = std::vector<glm::dvec2>;

/// The area within width/2 of the lines: round ends and joints.
/// @param quarter_segments  straight pieces per quarter of a circle, >= 1
Shape stroke_shape(std::span<const Polyline> strokes, double width, int quarter_segments);

/// The area inside a simple ring, given in either direction.
Shape ring_shape(const Polyline& ring);

Shape unite(const Shape& a, const Shape& b);
Shape subtract(const Shape& a, const Shape& b);

/// `count` points on a circle, counter-clockwise from +x.
Polyline circle(const glm::dvec2& centre, double radius, int count);

/// A rectangle of the given half size with rounded corners, counter-clockwise.
/// @param corner_segments  pieces per corner; 0 with radius 0: four points
Polyline rounded_rectangle(const glm::dvec2& centre, const glm::dvec2& half, double radius,
                           int corner_segments);

/// Area of a shape from its triangles.
double area_of(const Shape& shape);

/// The shape moved: p -> origin + scale * p.
Shape moved(Shape shape, const glm::dvec2& origin, double scale = 1.0);

}  // namespace data
