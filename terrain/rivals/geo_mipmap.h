// GeoMipmapFront: geometric mip-mapping. Fixed blocks, each decimated regularly by a power of two; along a coarser
// neighbour the border is joined in fans, whatever the difference of levels is, so that there is no T-junction.
//
// Vertices are the samples, in the pool once and for all; indices are patterns that blocks of one shape share. A
// block is one draw item, or five where a neighbour is coarser by more than one level.
// Sources: de Boer (2000); Elykov, Lavrentiev et al. (Softlab-NSK), section 3.
#pragma once

#include "terrain/rivals/block_ladder.h"
#include "terrain/rivals/block_patterns.h"
#include "terrain/rivals/ground_vertex.h"

namespace terrain {

class GeoMipmapFront final : public LadderFront {
  public:
    /// @param grid   must outlive the front
    /// @param cells  along a block's side: a power of two, 2 … 128
    GeoMipmapFront(const data::HeightGrid& grid, int cells, unsigned threads);

    lod::PoolRegion pool_need() const override;
    void place(const lod::PoolRegion& region) override;
    void emit(const lod::View& view, lod::DrawList& out) override;
    uint64_t memory_bytes() const override;

  private:
    struct Pattern {
        uint32_t first_index = 0, index_count = 0;
    };
    /// All patterns of one block shape; indices count from the block's north-west sample.
    struct PatternBook {
        BlockShape shape;
        std::vector<Pattern>
            whole;  ///< [shift * 16 + mask] bit k: the neighbour on side k is one level coarser
        std::vector<Pattern> inner;  ///< [shift]
        std::vector<Pattern> strip;  ///< [(shift * 4 + side) * (top + 1) + outer_shift]

        const Pattern& strip_at(int shift, int side, int outer_shift) const {
            const int top = shape.top_shift();
            return strip[static_cast<size_t>((shift * 4 + side) * (top + 1) + outer_shift)];
        }
    };
    struct Stitch {
        int shift = 0;
        int outer_shift[4] = {};
        int mask = 0;           ///< sides whose neighbour is one level coarser
        bool is_simple = true;  ///< no difference above one level
    };

    uint32_t triangles_of(uint32_t block) const override;
    uint32_t on_move(uint32_t block, uint32_t from, lod::OperationCounts& operations) override;
    Pattern add_pattern(const std::vector<CellTriangle>& triangles);
    void add_book(const BlockShape& shape);
    const PatternBook& book_of(uint32_t block) const { return books_[book_[block]]; }
    int shift_of(uint32_t block) const { return top_shift_ - static_cast<int>(rung(block)); }
    Stitch stitch_of(uint32_t block) const;
    void add_items(uint32_t block, uint32_t instance, lod::DrawList& out);

    int top_shift_ = 0;
    std::vector<PatternBook> books_;
    std::vector<uint8_t> book_;      ///< [block]
    std::vector<uint32_t> indices_;  ///< of all patterns
    lod::PoolRegion region_;
    StaticVertices vertices_;
    bool are_indices_written_ = false;
};

}  // namespace terrain
