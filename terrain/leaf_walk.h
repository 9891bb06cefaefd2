// walk_leaves: visits every leaf triangle of a diamond mesh, depth first, in Sierpinski order.
//
// The one traversal of the bintree: what it is for (culling, writing indices, collecting a static mesh) is the
// visitor's business. Recursion is at most 2 log2(side) + 1 deep.
#pragma once

#include "terrain/diamond_mesh.h"

namespace terrain {

/// Corners of a leaf, by record.
struct Leaf {
    DiamondIndex apex, left, right;
};

/// A Visitor has
///   a type State, copied down the tree,
///   bool enter(DiamondIndex, State&): whether to go on below the triangles of this diamond,
///   void leaf(const Leaf&, DiamondIndex, int half): a leaf; the record whose half it is, kOutside for half a cell.
template <typename Visitor>
class LeafWalk {
  public:
    LeafWalk(const DiamondMesh& mesh, Visitor& visitor) : mesh_(mesh), visitor_(visitor) {}

    /// Both triangles of the root. Corner records: 0 (0,0), 1 (side,0), 2 (0,side), 3 (side,side).
    void run(const typename Visitor::State& state) {
        const Diamond& root = mesh_[kRoot];
        for (int half = 0; half < 2; ++half) {
            const GridPoint left =
                step_from(root.centre(), root.apex_dir + 4 * half + 2, mesh_.domain().reach(0));
            const DiamondIndex corner = (left.x == 0 ? 0u : 1u) + (left.y == 0 ? 0u : 2u);
            triangle(kRoot, half, corner, 3u - corner, state);
        }
    }

  private:
    /// The triangle whose hypotenuse left-right has its middle at `index`; half: which parent is the apex.
    void triangle(DiamondIndex index, int half, DiamondIndex left, DiamondIndex right,
                  typename Visitor::State state) {
        const Diamond& d = mesh_[index];
        if (!visitor_.enter(index, state)) return;
        const DiamondIndex apex = d.parent[half];
        if (!d.is_split) {
            visitor_.leaf({apex, left, right}, index, half);
            return;
        }
        // Sides 0 and 3 belong to the apex in apex_dir, 1 and 2 to the one opposite.
        below(index, half == 0 ? 0 : 2, apex, left, state);
        below(index, half == 0 ? 3 : 1, right, apex, state);
    }

    /// The half of a split triangle behind one side: its apex is the diamond just split.
    void below(DiamondIndex index, int side, DiamondIndex left, DiamondIndex right,
               const typename Visitor::State& state) {
        const DiamondIndex child = mesh_.child(index, side);
        if (child == kOutside) {  // finer than the grid: half a cell
            visitor_.leaf({index, left, right}, kOutside, 0);
            return;
        }
        triangle(child, mesh_[child].parent[0] == index ? 0 : 1, left, right, state);
    }

    const DiamondMesh& mesh_;
    Visitor& visitor_;
};

}  // namespace terrain
