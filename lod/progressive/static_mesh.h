// StaticMesh: one state of a vertex hierarchy as plain triangles, chosen by tolerance or by number of triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

struct StaticMesh {
    std::vector<std::array<VertexId, 3>> triangles;
    std::vector<uint32_t> full_triangle;  ///< [triangles] which of the full mesh each was
    double error_m = 0.0;                 ///< largest of the active nodes
};

/// Every collapse that is within the tolerance and legal, in the order of the build.
StaticMesh mesh_at_tolerance(const VertexHierarchy& hierarchy, double tolerance_m);

/// A hierarchy and by how much its errors grow in the model.
struct ScaledHierarchy {
    const VertexHierarchy* hierarchy = nullptr;
    double scale = 1.0;
};

/// States of several hierarchies with one tolerance, the least that leaves no more than `triangles` in all; what can be
/// kept of that number is kept. When nothing collapses further, more may be left.
/// Cost: O(n log n).
std::vector<StaticMesh> meshes_of_size(std::span<const ScaledHierarchy> hierarchies, uint64_t triangles);

/// Triangles that face away from where they face in the full mesh; those that have no area there do not count.
uint64_t count_flipped(const VertexHierarchy& hierarchy, const StaticMesh& mesh);

/// Generations from the oldest root to the last leaf; 1: nothing collapses.
uint32_t count_levels(const VertexHierarchy& hierarchy);

}  // namespace lod
