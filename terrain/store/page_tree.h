// The pages as a tree: below each the pages of the next group that cover the same ground.
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

}  // namespace terrain
