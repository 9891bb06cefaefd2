// A plain way to a vertex hierarchy, for tests: shortest edge first, (a, b) -> a's place, all bounds by brute force.
//
// Keeps what it saw: every triangle of every mesh on the way, and the star of every collapse.
#pragma once

#include <set>
#include <tuple>
#include <vector>

#include "lod/progressive/vertex_hierarchy.h"

namespace lod_test {

struct PlainMesh {
    std::vector<glm::vec3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;
};

/// A triangle of the full mesh with the corners it had at some moment.
using SeenTriangle = std::tuple<uint32_t, lod::NodeId, lod::NodeId, lod::NodeId>;

struct PlainHistory {
    lod::VertexHierarchy hierarchy;
    std::set<SeenTriangle> seen;  ///< none of them turned by more than 60 degrees where its collapse made it
    std::vector<std::set<SeenTriangle>> before, after;  ///< [collapses] the whole star around it
};

/// Collapses until no edge may go without turning a triangle or breaking the surface.
PlainHistory make_plain_history(const PlainMesh& mesh);

/// Bumpy n x n samples of a plane, open at its border; unit spacing 1 / n.
PlainMesh bumpy_sheet(uint32_t n, uint64_t seed);
/// A closed bumpy ring of n x m samples.
PlainMesh bumpy_ring(uint32_t n, uint32_t m, uint64_t seed);
/// Both, apart from each other.
PlainMesh joined(const PlainMesh& a, const PlainMesh& b);

}  // namespace lod_test
