// TrackPiece: how a straight line of the world runs over a curved grid.
//
// Column, row and height along a line are no straight functions (10 km of straight line rise 2 m above the
// ellipsoid at each end), but smooth ones: a polynomial of degree 7 follows them over tens of kilometres to less
// than a micrometre. It is fitted to exact positions (GeographicLib, PROJ) at 8 Chebyshev nodes; how small its last
// coefficients are says how good it is, and their sizes bound its second derivative, so any part of it lies within
// a known distance of a straight line in the grid.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "data/ground_frame.h"

namespace data {

/// x: column, y: row, z: height in metres; s runs over [-1, 1].
struct TrackPiece {
    static constexpr size_t kTerms = 8;

    double begin = 0.0, end = 1.0;         ///< part of the line that s = -1 … 1 stands for
    std::array<glm::dvec3, kTerms> terms;  ///< of the Chebyshev polynomials of s
    glm::dvec3 bend{0.0};                  ///< no second derivative by s is larger

    glm::dvec3 at(double s) const;
    double share_at(double s) const { return begin + (end - begin) * 0.5 * (s + 1.0); }
};

struct WorldLine {
    glm::dvec3 from{0.0}, to{0.0};  ///< world
};

enum class TrackFit : uint8_t {
    kGood,
    kTooLong,  ///< take two halves
    kNowhere   ///< no place of it has a position in the grid
};

/// Fits the part [out.begin, out.end] of a line. Columns and rows may lie outside the raster, and run on beyond a
/// full turn of longitude.
///
/// Good is: the last two coefficients are below 0.1 um; or, where the transformation itself is not smooth (grids
/// of datum shifts, iterations), below 1 mm and the part is shorter than a cell.
/// Cost: 8 exact positions, 2 us; 10 us where PROJ is asked.
TrackFit fit_track(const GroundFrame& frame, const WorldLine& line, TrackPiece& out);

}  // namespace data
