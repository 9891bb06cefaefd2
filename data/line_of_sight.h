// line_of_sight: does the ground stand between two points of the world, and where first?
//
// A line is blocked when some point of it lies more than 1 um below ground_height (data/ground_height.h) at its own
// foot; who touches the ground sees and is seen, so both ends may stand on it. An end below the ground is blocked.
// A void neither blocks nor clears: the line passes, and is marked where it runs below the height that is
// interpolated across the void. Beyond the raster nothing blocks; who enters it below the ground is blocked there.
//
// How: the line is a smooth curve over the grid (data/ground_track.h). It is halved, nearest part first, until a
// part is above everything in the rectangle under it (data/height_pyramid.h), or so short that, but for a known
// distance, it is straight over a handful of triangles: then its height above the ground is linear between
// crossings of their edges, and the sign at these decides. Where that distance could matter, it is halved on.
// Parts are cut, and decided, in the same way from both ends: swapping the ends never changes whether a line is
// blocked.
#pragma once

#include <span>

#include "data/ground_track.h"
#include "data/height_grid.h"
#include "data/height_pyramid.h"

namespace data {

/// What stands in the way.
struct Sight {
    bool is_blocked = false;
    bool is_through_void = false;  ///< before its end, it passes below the heights interpolated across a void
    double share = 1.0;         ///< of the line, from 0 to 1, to where it is blocked first; 1 when it is not
    glm::dvec3 end_world{0.0};  ///< the point there, within 2 um of the ground; or the line's end
};

/// From line.from to line.to. Ends that are not finite see each other.
/// @param pyramid  of this grid as it is now
/// Cost: some us, almost whatever the length (query_bench).
/// Accuracy: the line's height above the ground within 1 um, for lines up to 100 km long.
Sight line_of_sight(const HeightGrid& grid, const HeightPyramid& pyramid, const WorldLine& line);

/// One answer per line, out.size() == lines.size(). The same as one by one, for any number of threads.
/// @param threads  >= 1
void lines_of_sight(const HeightGrid& grid, const HeightPyramid& pyramid, std::span<const WorldLine> lines,
                    std::span<Sight> out, unsigned threads);

}  // namespace data
