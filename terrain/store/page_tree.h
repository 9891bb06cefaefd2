// The pages as a tree: below each the pages of the next group that cover the same ground; and what lies in one.
#pragma once

#include <algorithm>

#include "terrain/page_layout.h"

namespace terrain {

/// Calls visit(PageId) for one page (near the root, where a group is a single page) or for 2 x 2; none below the
/// last group.
template <typename Visit>
void for_each_child(const PageLayout& layout, const PageId& id, const Visit& visit) {
    if (id.group + 1 >= layout.group_count()) return;
    const int split = layout.blocks(id.group + 1) / layout.blocks(id.group);
    for (int y = 0; y < split; ++y) {
        for (int x = 0; x < split; ++x)
            visit(PageId{id.group + 1, id.block_x * split + x, id.block_y * split + y});
    }
}

/// The page above; `id` must not be the root's.
inline PageId parent_of(const PageLayout& layout, const PageId& id) {
    const int split = layout.blocks(id.group) / layout.blocks(id.group - 1);
    return {id.group - 1, id.block_x / split, id.block_y / split};
}

/// Calls visit(centre, level) for the diamonds over a page's ground whose centres lie in the raster, those on its far
/// rims, which a neighbour's page holds, included.
template <typename Visit>
void for_each_diamond(const Domain& domain, const PageId& id, const Visit& visit) {
    const int reach = domain.reach(2 * id.group), width = 2 * reach * kPageSide;
    const GridPoint first{id.block_x * width, id.block_y * width};
    for (int y = first.y; y <= std::min(first.y + width, domain.height - 1); y += reach) {
        const int row = y / reach;
        for (int x = first.x; x <= std::min(first.x + width, domain.width - 1); x += reach) {
            const int column = x / reach;
            if ((row & 1) != 0 && (column & 1) != 0) visit(GridPoint{x, y}, 2 * id.group);
            if (((row ^ column) & 1) != 0) visit(GridPoint{x, y}, 2 * id.group + 1);
        }
    }
}

}  // namespace terrain
