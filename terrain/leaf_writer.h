// LeafWriter: leaf triangles as indices, each as it is or as a patch: bisected so many levels deeper over the samples
// of the grid, as far as it goes.
#pragma once

#include <span>
#include <vector>

#include "terrain/bintree_triangle.h"
#include "terrain/diamond_rank.h"
#include "terrain/leaf_cover.h"
#include "terrain/patch_vertices.h"

namespace terrain {

struct LeafWriter {
    /// A corner of what is written.
    struct Corner {
        GridPoint at;
        uint32_t slot = 0;
        bool is_void = false;
    };

    const DiamondTable& table;
    const DiamondMesh& mesh;
    std::span<const DiamondRank> ranks;  ///< [record]
    int deeper = 0;                      ///< levels below the mesh
    PatchVertices& patches;
    std::vector<uint32_t>& indices;

    void write(const BintreeTriangle& leaf) const {
        const Corner apex = corner_of(leaf.apex), left = corner_of(leaf.left), right = corner_of(leaf.right);
        if (!covers_raster(table.domain, {apex.at, left.at, right.at})) return;
        if (leaf.diamond == kOutside) return write_half_cell(apex, left, right);
        const Diamond& d = mesh[leaf.diamond];
        if (deeper > 0) return bisect(d.level, deeper, apex, left, right);
        if (table.has_voids && ranks[leaf.diamond].source.is_half_empty(d.apex_dir + 4 * leaf.half)) return;
        push(apex, left, right);
    }

    /// What was written is no longer drawn.
    void release(std::span<const uint32_t> contents) const {
        if (deeper > 0) patches.release(contents);
    }

  private:
    Corner corner_of(DiamondIndex index) const {
        return {mesh[index].centre(), index, table.has_voids && ranks[index].source.is_void()};
    }

    /// @param level  of the diamond whose half the triangle is
    void bisect(int level, int levels_left, const Corner& apex, const Corner& left,
                const Corner& right) const {
        if (level > table.domain.finest_level()) return write_half_cell(apex, left, right);
        if (!covers_raster(table.domain, {apex.at, left.at, right.at})) return;
        const GridPoint centre{(left.at.x + right.at.x) / 2, (left.at.y + right.at.y) / 2};
        if (levels_left == 0) {
            if (!table.has_voids || has_ground(centre, level, apex.at)) push(apex, left, right);
            return;
        }
        const Corner middle{centre, patches.slot_of(centre, level),
                            table.has_voids && table.at(centre, level).is_void()};
        bisect(level + 1, levels_left - 1, middle, apex, left);
        bisect(level + 1, levels_left - 1, middle, right, apex);
    }

    bool has_ground(GridPoint centre, int level, GridPoint apex) const {
        const int dir = apex_direction(table.domain, centre, level);
        const bool is_first = step_from(centre, dir, table.domain.reach(level)) == apex;
        return !table.at(centre, level).is_half_empty(is_first ? dir : dir + 4);
    }

    void write_half_cell(const Corner& apex, const Corner& left, const Corner& right) const {
        if (apex.is_void || left.is_void || right.is_void) return;
        if (covers_raster(table.domain, {apex.at, left.at, right.at})) push(apex, left, right);
    }

    /// Counter-clockwise seen from above: rows run south, so left and right change places.
    void push(const Corner& apex, const Corner& left, const Corner& right) const {
        for (const Corner* corner : {&apex, &right, &left}) {
            indices.push_back(corner->slot);
            if (deeper > 0) patches.hold(corner->slot);
        }
    }
};

}  // namespace terrain
