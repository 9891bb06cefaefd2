// Footing: a ring of a footprint laid on the source ground, cut wherever the ground bends.
//
//   corner        corner        The full-resolution terrain mesh is cut by four families of straight lines in
//     |\__ roof     |           grid coordinates: col = i, row = i, col - row = 2i, col + row = 2i (each cell's
//     |             |           diagonal joins its even corners). Between two of them the ground along a wall
//     o---o--o------o  feet     is a straight line, so feet at the crossings lie on it everywhere.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "data/height_grid.h"

namespace objects {

/// Where buildings stand. Plane: grid coordinates (column, row) of `grid`, or site x, y without a grid.
struct Ground {
    const data::HeightGrid* grid = nullptr;  ///< null: the ground is at height 0 everywhere
    data::WorldFrame world;
};

/// A point of the ground under a wall.
struct Foot {
    glm::dvec2 plane{0.0};
    double height_m = 0.0;
};

/// One ring: edge i goes from feet[first_foot[i]] to feet[first_foot[i + 1]], its ends are footprint corners.
struct Footing {
    std::vector<Foot> feet;            ///< in the ring's order; the last repeats the first
    std::vector<uint32_t> first_foot;  ///< [edges + 1]

    size_t edges() const { return first_foot.size() - 1; }
};

/// World position of a point of the plane at a height.
glm::dvec3 world_at(const Ground& ground, const glm::dvec2& plane, double height_m);

/// Lays a ring of site points on the ground. Cost: one height per foot, a world position for none.
/// @returns false when some foot is outside the terrain or on a void; `out` is then incomplete
bool lay_ring(const Ground& ground, std::span<const glm::dvec2> ring, Footing& out);

/// Heights along a footing, weighted by length in the plane; exact for the piecewise straight ground.
struct GroundProfile {
    double mean_m = 0.0, lowest_m = 0.0, highest_m = 0.0;
};
GroundProfile profile_of(const Footing& footing);

}  // namespace objects
