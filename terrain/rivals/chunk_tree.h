// ChunkTree: the chunks of a quadtree over a raster, what each costs in metres and how deep its skirt must hang.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "data/height_grid.h"
#include "terrain/diamond.h"
#include "terrain/rivals/ground_box.h"

namespace terrain {

/// A square of `cells` x `cells` quads at one spacing, clamped to the raster.
struct Chunk {
    static constexpr uint32_t kNone = 0xffffffffu;

    GridPoint origin;  ///< north-west sample
    int shift = 0;     ///< spacing of its vertices is 1 << shift samples
    GridPoint quads;   ///< along x and y, 1 … cells; the last of a row may be narrower
    uint32_t parent = kNone;
    std::array<uint32_t, 4> child{kNone, kNone, kNone, kNone};  ///< kNone: beyond the raster
    float error_m = 0.0f;  ///< true maximum over all covered samples; never below a child's
    float skirt_m = 0.0f;  ///< reaches below every edge that another chunk may show here
    GroundBox box;

    bool is_leaf() const { return shift == 0; }
};

struct ChunkTree {
    int cells = 0;
    std::vector<Chunk> chunks;  ///< [0] is the root; parents before children
};

/// @param cells    quads along a chunk's side, a power of two
/// @param threads  >= 1; the result does not depend on it
/// Cost: O(samples * levels).
ChunkTree make_chunk_tree(const data::HeightGrid& grid, int cells, unsigned threads);

/// The sample of a chunk's vertex; i and j count from its origin, 0 … quads.
inline GridPoint chunk_sample(const data::HeightGrid& grid, const Chunk& chunk, int i, int j) {
    const int x = chunk.origin.x + (i << chunk.shift), y = chunk.origin.y + (j << chunk.shift);
    return {x < grid.width ? x : grid.width - 1, y < grid.height ? y : grid.height - 1};
}

}  // namespace terrain
