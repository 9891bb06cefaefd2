// StarMeasures: what has to be measured to bound the triangles that collapses make, as plain numbers: whoever measures
// needs no map and no mesh, and may do it later, on another thread.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

/// Of some collapses in a row. Lists lie one after the other; each entry says where its own part of the next list ends.
struct StarMeasures {
    struct Star {
        std::array<NodeId, 2> children{};
        glm::vec3 position{0.0f};  ///< of the node, mesh frame
        double vertices_m = 0.0;   ///< farthest full vertex from its triangle, as far as anybody would notice
        double owner_m = 0.0;      ///< the node's distance from the full triangle that owns it
        uint32_t passings_end = 0;  ///< of passings that concern the node
        uint32_t spokes_end = 0;
    };
    /// An edge from the node to its ring, and the ring's edge behind it, counter-clockwise.
    struct Spoke {
        CornerId corner = 0, mate = 0;  ///< its half-edges; a border has no mate
        CornerId outer = 0;             ///< the ring's half-edge
        NodeId ring = 0, next_ring = 0;
        uint32_t crossings_end = 0;
        uint32_t passings_end = 0;  ///< of passings that concern the spoke
    };
    /// A full edge whose image crosses the spoke.
    struct Crossing {
        NodeId u = 0, v = 0;
    };
    /// A full border edge whose image passes a node.
    struct Passing {
        NodeId node = 0, u = 0, v = 0;
    };

    std::vector<Star> stars;
    std::vector<Spoke> spokes;
    std::vector<Crossing> crossings;
    std::vector<Passing> passings;

    void clear() { stars.clear(), spokes.clear(), crossings.clear(), passings.clear(); }
};

/// 2^-40 of the largest coordinate: places are not known so well, so what is below counts as 0.
/// @param places  metres, finite
inline double noise_m(std::span<const glm::vec3> places) {
    double largest_m = 0.0;
    for (const glm::vec3& p : places)
        largest_m =
            std::max({largest_m, std::abs(double(p.x)), std::abs(double(p.y)), std::abs(double(p.z))});
    return largest_m * 0x1p-40;
}

}  // namespace lod
