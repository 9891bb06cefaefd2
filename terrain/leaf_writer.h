// LeafWriter: leaf triangles as indices.
#pragma once

#include <vector>

#include "terrain/leaf_cover.h"

namespace terrain {

struct LeafWriter {
    LeafCover cover;
    std::vector<uint32_t>& indices;

    /// Counter-clockwise seen from above: rows run south, so left and right change places.
    void write(const BintreeTriangle& leaf) const {
        if (!cover.is_drawn(leaf)) return;
        indices.push_back(leaf.apex);
        indices.push_back(leaf.right);
        indices.push_back(leaf.left);
    }
};

}  // namespace terrain
