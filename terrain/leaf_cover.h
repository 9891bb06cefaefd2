// LeafCover: which leaf triangles are drawn at all: not those squeezed to nothing beyond the raster, not holes.
#pragma once

#include "data/height_grid.h"
#include "terrain/diamond_table.h"
#include "terrain/leaf_walk.h"

namespace terrain {

struct LeafCover {
    const data::HeightGrid& grid;
    const DiamondTable& table;
    const DiamondMesh& mesh;

    /// @param diamond  as LeafWalk gives it
    bool is_drawn(const Leaf& leaf, const Diamond* diamond, int half) const {
        const GridPoint a = mesh[leaf.apex].centre(), l = mesh[leaf.left].centre(),
                        r = mesh[leaf.right].centre();
        if (is_squeezed(a, l, r)) return false;
        if (!grid.has_voids()) return true;
        if (diamond == nullptr) return !is_void(a) && !is_void(l) && !is_void(r);
        const int dir = (diamond->apex_dir + 4 * half) & 7;
        return (table.empty_halves[table.index(diamond->centre(), diamond->level)] >> half_bit(dir) & 1) == 0;
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
    bool is_void(GridPoint p) const {
        p = table.domain.clamped(p);
        return grid.void_at(p.x, p.y);
    }
};

}  // namespace terrain
