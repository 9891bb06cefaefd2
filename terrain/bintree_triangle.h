// BintreeTriangle: one triangle of the bintree in a diamond mesh, by records, and the way down to its leaves.
//
//              apex                 A triangle is half of the diamond whose centre is the middle of its
//             / | \                 hypotenuse. When that diamond is split, it consists of two triangles whose
//            /  |  \                apex is that centre. Left before right, all the way down, is the order of
//        left - m - right           Sierpinski's curve: neighbours in it share an edge.
#pragma once

#include <array>

#include "terrain/diamond_mesh.h"

namespace terrain {

/// A triangle whose apex is split, and so are the ends of its hypotenuse.
struct BintreeTriangle {
    DiamondIndex diamond = kOutside;  ///< whose half it is; kOutside: half a cell, finer than any diamond
    int half = 0;                     ///< which of the diamond's parents is the apex
    DiamondIndex apex = kOutside, left = kOutside, right = kOutside;
};

/// One of the two triangles of the whole domain. Corner records: 0 (0,0), 1 (side,0), 2 (0,side), 3 (side,side).
inline BintreeTriangle root_triangle(const DiamondMesh& mesh, int half) {
    const Diamond& root = mesh[kRoot];
    const GridPoint left = step_from(root.centre(), root.apex_dir + 4 * half + 2, mesh.domain().reach(0));
    const DiamondIndex corner = (left.x == 0 ? 0u : 1u) + (left.y == 0 ? 0u : 2u);
    return {kRoot, half, root.parent(static_cast<uint32_t>(half)), corner, 3u - corner};
}

inline bool is_leaf(const DiamondMesh& mesh, const BintreeTriangle& triangle) {
    return triangle.diamond == kOutside || !mesh[triangle.diamond].is_split;
}

/// The two triangles a split one consists of, in order.
inline std::array<BintreeTriangle, 2> children_of(const DiamondMesh& mesh, const BintreeTriangle& t) {
    const auto child = [&](int side, DiamondIndex left, DiamondIndex right) {
        const DiamondIndex diamond = mesh.child(t.diamond, side);
        const int half = diamond == kOutside || mesh[diamond].parent0 == t.diamond ? 0 : 1;
        return BintreeTriangle{diamond, half, t.diamond, left, right};
    };
    // Sides 0 and 3 belong to the apex in apex_dir, 1 and 2 to the one opposite.
    return {child(t.half == 0 ? 0 : 2, t.apex, t.left), child(t.half == 0 ? 3 : 1, t.right, t.apex)};
}

/// The triangle that the split of its apex's diamond divided; its diamond and half are the apex's.
inline BintreeTriangle parent_of(const DiamondMesh& mesh, const BintreeTriangle& t) {
    const Diamond& split = mesh[t.apex];
    const auto [from, to] = mesh.edge_ends(t.apex);
    const bool is_left_half =
        split.parent0 == t.left || split.parent1 == t.left;  // as children_of() turns them
    const DiamondIndex apex = is_left_half ? t.left : t.right, end = is_left_half ? t.right : t.left;
    const DiamondIndex other = end == from ? to : from;
    const int half = split.parent0 == apex ? 0 : 1;
    return {t.apex, half, apex, is_left_half ? end : other, is_left_half ? other : end};
}

}  // namespace terrain
