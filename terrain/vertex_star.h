// The triangles of a mesh at one vertex.
#pragma once

#include <array>
#include <cstddef>

#include "terrain/bintree_triangle.h"

namespace terrain {

/// Calls visit(triangle) for every leaf at the centre of a split diamond, down from its four quarters, or at a corner
/// of the domain.
/// Cost: about 20 ns for each of four to eight triangles a level below the diamond.
template <typename Visit>
void visit_star(const DiamondMesh& mesh, DiamondIndex vertex, const Visit& visit) {
    std::array<BintreeTriangle, 4 + 2 * kMostLevels> waiting;
    size_t count = 0;
    const auto add = [&](const BintreeTriangle& triangle) {
        if (triangle.apex == vertex || triangle.left == vertex || triangle.right == vertex)
            waiting[count++] = triangle;
    };
    if (vertex < kCornerCount) {
        for (int half = 0; half < 2; ++half)
            add(root_triangle(mesh, half));
    } else {
        const auto [from, to] = mesh.edge_ends(vertex);
        for (int half = 0; half < 2; ++half) {
            const DiamondIndex apex = mesh[vertex].parent(static_cast<uint32_t>(half));
            if (!is_record(apex)) continue;
            for (const BintreeTriangle& quarter :
                 children_of(mesh, {vertex, half, apex, half == 0 ? from : to, half == 0 ? to : from}))
                add(quarter);
        }
    }
    while (count > 0) {
        const BintreeTriangle triangle = waiting[--count];
        if (is_leaf(mesh, triangle)) {
            visit(triangle);
            continue;
        }
        for (const BintreeTriangle& child : children_of(mesh, triangle))
            add(child);
    }
}

}  // namespace terrain
