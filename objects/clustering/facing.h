// Facing: triangles of closed convex solids in the order of where they look, so that those which look away need not even
// be submitted.
//
//     indices   [ the rest | up | west … all around, by sixteenths … north-west | down | glass ]
//
// Behind a face of a closed convex solid the eye is cut off from it by the solid itself. So a range whose faces all have
// the eye behind them changes no pixel (objects/facing_ranges.h decides that for an eye). Whatever is open, dented,
// of glass or not oriented outwards is part of the rest, which is always drawn.
#pragma once

#include <cstdint>
#include <vector>

#include "objects/cluster_tree.h"

namespace objects {

/// How a geometry's opaque indices are divided, and where it lies.
struct Facings {
    std::vector<FacingRange> ranges;  ///< in the order of the indices; empty: all is rest
    glm::vec3 centre{0.0f};
    float radius_m = 0.0f;      ///< of a sphere about the centre that holds all vertices, rounded up
    std::vector<Solid> solids;  ///< the largest of the closed convex solids, by extent
};

/// @param vertices  of one geometry
/// @param indices   three a triangle, opaque ones only; put into order. A gap of 1e-5 of the extent does not open a solid
/// Cost: O(n log n), and faces times corners for each closed part of up to 512 faces. Deterministic.
Facings sort_by_facing(std::span<const lod::Vertex> vertices, std::span<uint32_t> indices);

}  // namespace objects
