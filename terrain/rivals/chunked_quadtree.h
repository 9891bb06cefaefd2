// ChunkedQuadtree: a cut through a quadtree of chunks, each a fixed grid of triangles with a skirt around it.
//
// Every chunk of every level lies in the pool once and for all and is one draw item. Nothing joins neighbours:
// skirts hang from the edges and hide what would be a gap. Refining replaces a chunk by its four children.
// Source: Ulrich, Rendering Massive Terrains using Chunked Level of Detail Control (2002), with true errors.
#pragma once

#include <vector>

#include "terrain/rivals/chunk_tree.h"
#include "terrain/rivals/ground_vertex.h"
#include "terrain/rivals/ranking.h"
#include "terrain/rivals/rival_front.h"

namespace terrain {

class ChunkedQuadtree final : public RivalFront {
  public:
    /// @param grid   must outlive the front
    /// @param cells  quads along a chunk's side: a power of two, 2 … 256
    ChunkedQuadtree(const data::HeightGrid& grid, int cells, unsigned threads);

    void begin_frame(std::span<const lod::View> views, double time_s) override;
    double refine_error_px() override;
    double coarsen_error_px() override;
    lod::Step refine() override;
    lod::Step coarsen(double limit_px) override;
    uint64_t triangles() const override { return triangles_; }
    double error_px() override;
    lod::OperationCounts operations() const override { return operations_; }
    uint64_t hash() const override;
    lod::PoolRegion pool_need() const override;
    void place(const lod::PoolRegion& region) override;
    void emit(const lod::View& view, lod::DrawList& out) override;
    uint64_t emitted_triangles() const override { return emitted_; }
    std::string validate() const override;
    uint64_t memory_bytes() const override;

    const ChunkTree& tree() const { return tree_; }
    bool is_drawn(uint32_t chunk) const { return state_[chunk] == State::kDrawn; }

  private:
    enum class State : uint8_t { kBelow, kDrawn, kSplit };  ///< below the cut, in it, above it
    /// Indices that chunks of one extent share: the grid, then the skirt. Vertices: the grid's row by row, then the
    /// skirt's lower rim, clockwise from the north-west.
    struct Pattern {
        GridPoint quads;
        uint32_t first_index = 0, index_count = 0;
    };

    size_t add_pattern(GridPoint quads);
    void add_vertices(const Chunk& chunk, std::vector<lod::Vertex>& out) const;
    bool can_merge(uint32_t chunk) const;
    struct Keys {
        double refine_px, minus_coarsen_px;
    };
    Keys keys_of(uint32_t chunk) const;
    void rank(uint32_t chunk);
    double chunk_error_px(uint32_t chunk) const;
    uint64_t triangles_of(uint32_t chunk) const { return patterns_[pattern_[chunk]].index_count / 3; }
    lod::Step set_split(uint32_t chunk, bool is_split);

    const data::HeightGrid& grid_;
    ChunkTree tree_;
    std::vector<State> state_;            ///< [chunk]
    std::vector<Sight> sights_;           ///< [chunk] of this frame, of chunks not below the cut
    std::vector<uint8_t> pattern_;        ///< [chunk]
    std::vector<uint32_t> first_vertex_;  ///< [chunk], one more at the end
    std::vector<Pattern> patterns_;
    std::vector<uint32_t> indices_;
    std::vector<lod::ViewMetric> views_;
    Ranking refine_, coarsen_;  ///< keys: pixels of what can be split; negated, of what can be merged
    uint64_t triangles_ = 0, emitted_ = 0;
    lod::OperationCounts operations_;
    lod::PoolRegion region_;
    StaticVertices vertices_;
    bool is_first_view_ = true, are_indices_written_ = false;
};

}  // namespace terrain
