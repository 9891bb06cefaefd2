// LeafCover: which triangles are drawn at all: not those squeezed to nothing beyond the raster, not holes.
#pragma once

#include <span>

#include "terrain/bintree_triangle.h"
#include "terrain/diamond_rank.h"

namespace terrain {

struct LeafCover {
    const DiamondTable& table;
    const DiamondMesh& mesh;
    std::span<const DiamondRank> ranks;  ///< [record]

    bool is_drawn(const BintreeTriangle& leaf) const {
        if (is_squeezed(mesh[leaf.apex].centre(), mesh[leaf.left].centre(), mesh[leaf.right].centre()))
            return false;
        if (!table.has_voids) return true;
        if (leaf.diamond == kOutside)
            return !is_void(leaf.apex) && !is_void(leaf.left) && !is_void(leaf.right);
        return !ranks[leaf.diamond].source.is_half_empty(mesh[leaf.diamond].apex_dir + 4 * leaf.half);
    }

  private:
    bool is_squeezed(GridPoint a, GridPoint b, GridPoint c) const {
        const Domain& domain = table.domain;
        if (domain.in_raster(a) && domain.in_raster(b) && domain.in_raster(c)) return false;
        a = domain.clamped(a);
        b = domain.clamped(b);
        c = domain.clamped(c);
        return int64_t(b.x - a.x) * (c.y - a.y) == int64_t(c.x - a.x) * (b.y - a.y);
    }
    bool is_void(DiamondIndex index) const { return ranks[index].source.is_void(); }
};

}  // namespace terrain
