// VipmBlocks: a view-independent progressive mesh per block; a block moves along its one sequence of splits.
//
// A rung is a stop of the sequence, eight an octave of error. Blocks agree on their borders: vertices there go by
// powers of two, and where the neighbour still has more of them, the triangles at the border are drawn as fans.
// A block's indices are written anew when it or a neighbour's border has changed.
// Sources: Hoppe (1996); Elykov, Lavrentiev et al. (Softlab-NSK), sections 4.1 to 4.3, whose remedies for cracks
// (borders at full detail, overlapping blocks) the fans replace.
#pragma once

#include "terrain/rivals/block_ladder.h"
#include "terrain/rivals/ground_vertex.h"
#include "terrain/rivals/progressive_block.h"
#include "terrain/rivals/slot_pool.h"

namespace terrain {

class VipmBlocks final : public LadderFront {
  public:
    /// @param grid   must outlive the front
    /// @param cells  along a block's side: a power of two, 2 … 64
    /// Cost: about 5 us of one thread per sample.
    VipmBlocks(const data::HeightGrid& grid, int cells, unsigned threads);

    lod::PoolRegion pool_need() const override;
    void place(const lod::PoolRegion& region) override;
    void emit(const lod::View& view, lod::DrawList& out) override;
    uint64_t memory_bytes() const override;

    const ProgressiveBlock& block(uint32_t index) const { return meshes_[index]; }

  private:
    using Stop = ProgressiveBlock::Stop;
    struct Write {
        uint32_t first_index;
        size_t begin, end;  ///< of staging_
    };

    uint32_t triangles_of(uint32_t block) const override;
    uint32_t on_move(uint32_t block, uint32_t from, lod::OperationCounts& operations) override;
    const Stop& stop(uint32_t block) const { return meshes_[block].stops[rung(block)]; }
    std::array<uint8_t, 4> border_of(uint32_t block) const;
    void fit_slot(uint32_t block);
    void stage(uint32_t block);
    void write(lod::DrawList& out);

    std::vector<ProgressiveBlock> meshes_;  ///< [block]; their corners are those of the rung
    std::vector<uint32_t> first_vertex_;    ///< [block], one more at the end
    std::vector<SlotPool::Slot> slots_;     ///< [block] in the region's indices
    std::vector<uint8_t> is_dirty_;         ///< [block] its indices in the pool are not what should be drawn
    SlotPool slot_pool_;
    lod::PoolRegion region_;
    StaticVertices vertices_;
    std::vector<uint32_t> staging_;  ///< indices written this frame
    std::vector<Write> writes_;
};

}  // namespace terrain
