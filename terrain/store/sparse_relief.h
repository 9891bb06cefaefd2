// SparseRelief: level ground with relief in some places: a raster far too large to be held, the Earth for one.
#pragma once

#include <span>
#include <vector>

#include "data/height_grid.h"
#include "terrain/diamond_source.h"
#include "terrain/triangle_error.h"

namespace terrain {

/// A rectangle of samples inside the raster.
struct ReliefPatch {
    GridPoint first;              ///< its north-western sample
    int width = 0, height = 0;    ///< samples, both >= 1
    std::vector<float> height_m;  ///< [height * width], no voids

    bool contains(GridPoint p) const {
        return p.x >= first.x && p.y >= first.y && p.x < first.x + width && p.y < first.y + height;
    }
    float at(GridPoint p) const {
        return height_m[static_cast<size_t>(p.y - first.y) * static_cast<size_t>(width) +
                        static_cast<size_t>(p.x - first.x)];
    }
};

struct SparseRelief {
    Domain domain;
    data::GroundFrame frame;
    float level_m = 0.0f;              ///< where no patch lies
    std::vector<ReliefPatch> patches;  ///< the first that has a sample tells it

    /// Of a point of the domain; beyond the raster that of its nearest sample. Cost: O(patches).
    float height_at(GridPoint p) const;
};

/// An upper bound of |height - plane| over all samples a triangle covers, and the plane: triangle_error's of the raster,
/// but for what is level, which counts by the heights of the corners.
/// @param t  in the domain, possibly beyond the raster
/// Cost: O(patches + samples of patches below the triangle).
TriangleError sparse_triangle_error(const SparseRelief& relief, const TriangleCorners& t);

/// Everything of one diamond that needs no other diamond: its error is not saturated yet. A table's fill_diamond, for a
/// sparse relief.
DiamondSource sparse_facts(const SparseRelief& relief, GridPoint centre, int level);

/// A page of a group where all is level: what every page says that no patch is near.
/// @param out  kPageEntries
void fill_level_page(const SparseRelief& relief, int group, std::span<DiamondSource> out);

}  // namespace terrain
