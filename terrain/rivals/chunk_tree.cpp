#include "terrain/rivals/chunk_tree.h"

#include <algorithm>

#include "lod/base/check.h"
#include "lod/base/parallel.h"
#include "terrain/rivals/surface_error.h"

namespace terrain {
namespace {

float own_error_m(const data::HeightGrid& grid, const Chunk& chunk) {
    float worst = 0.0f;
    for (int j = 0; j < chunk.quads.y; ++j) {
        for (int i = 0; i < chunk.quads.x; ++i) {
            const GridPoint nw = chunk_sample(grid, chunk, i, j), ne = chunk_sample(grid, chunk, i + 1, j);
            const GridPoint sw = chunk_sample(grid, chunk, i, j + 1);
            const GridPoint se = chunk_sample(grid, chunk, i + 1, j + 1);
            const bool is_even = ((i + j) & 1) == 0;
            worst = std::max({worst, surface_error_m(grid, is_even ? se : ne, nw, sw),
                              surface_error_m(grid, is_even ? nw : sw, se, ne)});
        }
    }
    return worst;
}

/// One line of samples, along a row or a column.
struct Line {
    const data::HeightGrid& grid;
    bool is_row;
    int at;  ///< its row or column

    int last() const { return (is_row ? grid.width : grid.height) - 1; }
    int last_line() const { return (is_row ? grid.height : grid.width) - 1; }
    double height_m(int i) const { return double(is_row ? grid.at(i, at) : grid.at(at, i)); }

    /// The line decimated to every (1 << shift)-th sample, at sample i.
    double decimated_m(int i, int shift) const {
        const int low = i >> shift << shift, high = std::min(low + (1 << shift), last());
        if (low == i || high == low) return height_m(i);
        return height_m(low) + (height_m(high) - height_m(low)) * (i - low) / (high - low);
    }
};

/// How far the edge of a chunk stands above the edges that chunks across the line may show there.
/// @param begin, end  the samples of the edge
double rise_over_others_m(const Line& line, int begin, int end, int shift, int cells) {
    if (line.at == 0 || line.at == line.last_line()) return 0.0;
    double worst = 0.0;
    // Chunks of a level meet here only where the line is a border of that level.
    for (int other = 0; line.at % (cells << other) == 0; ++other) {
        if (other == shift) continue;
        for (int i = begin; i <= end; ++i)
            worst = std::max(worst, line.decimated_m(i, shift) - line.decimated_m(i, other));
    }
    return worst;
}

float skirt_depth_m(const data::HeightGrid& grid, const Chunk& chunk, int cells, int top_shift) {
    const GridPoint a = chunk.origin;
    const GridPoint b = chunk_sample(grid, chunk, chunk.quads.x, chunk.quads.y);
    double depth = 0.0;
    for (const int row : {a.y, b.y})
        depth = std::max(depth, rise_over_others_m({grid, true, row}, a.x, b.x, chunk.shift, cells));
    for (const int col : {a.x, b.x})
        depth = std::max(depth, rise_over_others_m({grid, false, col}, a.y, b.y, chunk.shift, cells));
    // Chords on the curved Earth sag by as much; a millimetre covers roundings.
    const double longest = 1 << top_shift;
    return static_cast<float>(depth + longest * longest * grid.frame.chord_error_per_cell2().up_m + 1e-3);
}

struct Place {
    GridPoint origin;
    int shift;
    uint32_t parent;
};

Chunk chunk_at(const data::HeightGrid& grid, const Place& place, int cells) {
    const int s = 1 << place.shift;
    Chunk chunk;
    chunk.origin = place.origin;
    chunk.shift = place.shift;
    chunk.parent = place.parent;
    chunk.quads = {std::min(cells, (grid.width - 2 - place.origin.x) / s + 1),
                   std::min(cells, (grid.height - 2 - place.origin.y) / s + 1)};
    return chunk;
}

/// All chunks, level by level, without their measures.
void lay_out(const data::HeightGrid& grid, int top_shift, ChunkTree& tree) {
    tree.chunks.push_back(chunk_at(grid, {{0, 0}, top_shift, Chunk::kNone}, tree.cells));
    for (uint32_t i = 0; i < tree.chunks.size(); ++i) {
        const Chunk chunk = tree.chunks[i];
        if (chunk.is_leaf()) continue;
        const int half = tree.cells << (chunk.shift - 1);
        for (int k = 0; k < 4; ++k) {
            const GridPoint at{chunk.origin.x + (k & 1) * half, chunk.origin.y + (k >> 1) * half};
            if (at.x >= grid.width - 1 || at.y >= grid.height - 1) continue;
            tree.chunks[i].child[static_cast<size_t>(k)] = static_cast<uint32_t>(tree.chunks.size());
            tree.chunks.push_back(chunk_at(grid, {at, chunk.shift - 1, i}, tree.cells));
        }
    }
}

void measure(const data::HeightGrid& grid, Chunk& chunk, int cells, int top_shift) {
    const GridPoint last = chunk_sample(grid, chunk, chunk.quads.x, chunk.quads.y);
    chunk.box = ground_box(grid, {chunk.origin.x, chunk.origin.y, last.x, last.y});
    chunk.error_m = own_error_m(grid, chunk);
    chunk.skirt_m = skirt_depth_m(grid, chunk, cells, top_shift);
}

}  // namespace

ChunkTree make_chunk_tree(const data::HeightGrid& grid, int cells, unsigned threads) {
    CHECK(cells >= 2 && (cells & (cells - 1)) == 0 && grid.width >= 2 && grid.height >= 2);
    ChunkTree tree;
    tree.cells = cells;
    int top_shift = 0;
    while ((cells << top_shift) + 1 < std::max(grid.width, grid.height))
        ++top_shift;
    lay_out(grid, top_shift, tree);
    lod::parallel_for(threads, threads, [&](size_t begin, size_t end) {
        for (size_t part = begin; part < end; ++part) {
            for (size_t i = part; i < tree.chunks.size(); i += threads)
                measure(grid, tree.chunks[i], cells, top_shift);
        }
    });
    for (size_t i = tree.chunks.size(); i-- > 1;) {
        Chunk& parent = tree.chunks[tree.chunks[i].parent];
        parent.error_m = std::max(parent.error_m, tree.chunks[i].error_m);
    }
    return tree;
}

}  // namespace terrain
