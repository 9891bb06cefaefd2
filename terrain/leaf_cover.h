// LeafCover: which leaf triangles are drawn at all: not those squeezed to nothing beyond the raster, not holes.
#pragma once

#include <span>

#include "terrain/diamond_rank.h"
#include "terrain/leaf_walk.h"

namespace terrain {

struct LeafCover {
    const DiamondTable& table;
    const DiamondMesh& mesh;
    std::span<const DiamondRank> ranks;  ///< [record]

    /// @param diamond  as LeafWalk gives it: the record whose half the leaf is, kOutside for half a cell
    bool is_drawn(const Leaf& leaf, DiamondIndex diamond, int half) const {
        if (is_squeezed(leaf)) return false;
        if (!table.has_voids) return true;
        if (diamond == kOutside) return !is_void(leaf.apex) && !is_void(leaf.left) && !is_void(leaf.right);
        return !ranks[diamond].source.is_half_empty(mesh[diamond].apex_dir + 4 * half);
    }

  private:
    bool is_squeezed(const Leaf& leaf) const {
        const Domain& domain = table.domain;
        GridPoint a = mesh[leaf.apex].centre(), b = mesh[leaf.left].centre(), c = mesh[leaf.right].centre();
        if (domain.in_raster(a) && domain.in_raster(b) && domain.in_raster(c)) return false;
        a = domain.clamped(a);
        b = domain.clamped(b);
        c = domain.clamped(c);
        return int64_t(b.x - a.x) * (c.y - a.y) == int64_t(c.x - a.x) * (b.y - a.y);
    }
    bool is_void(DiamondIndex index) const { return ranks[index].source.is_void(); }
};

}  // namespace terrain
