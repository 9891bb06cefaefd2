// LadderFront: blocks of ground, each on one rung of its own ladder of detail; what geometric mip-mapping and
// blocks of progressive meshes have in common.
//
// A rung costs its block an error in metres, and it may cost the neighbour on a side another: where a finer block
// gives way to a coarser one along their border, the coarser is to blame. Both are the worst over every rung the
// neighbour may stand on, so blocks are steered independently and one operation moves one block by one rung.
#pragma once

#include <span>
#include <vector>

#include "terrain/rivals/block_grid.h"
#include "terrain/rivals/ranking.h"
#include "terrain/rivals/rival_front.h"

namespace terrain {

/// Errors of one rung, metres; never larger than the next coarser rung's.
struct Rung {
    float error_m = 0.0f;        ///< inside the block
    float side_error_m[4] = {};  ///< [side] inside the neighbour, at the border
};

/// The ladders of all blocks; rung 0 of each is the coarsest, the last one is the source itself.
struct Ladders {
    std::vector<uint32_t> first{0};  ///< [block] its first rung; one more at the end
    std::vector<Rung> rungs;

    uint32_t rung_count(uint32_t block) const { return first[block + 1] - first[block]; }
    const Rung& at(uint32_t block, uint32_t rung) const { return rungs[first[block] + rung]; }
    /// Appends one block's rungs, coarsest first, and makes them monotone.
    void add(std::span<const Rung> block_rungs);
};

class LadderFront : public RivalFront {
  public:
    void begin_frame(std::span<const lod::View> views, double time_s) override;
    double refine_error_px() override;
    double coarsen_error_px() override;
    lod::Step refine() override;
    lod::Step coarsen(double limit_px) override;
    uint64_t triangles() const override { return triangles_; }
    double error_px() override;
    lod::OperationCounts operations() const override { return operations_; }
    uint64_t hash() const override;
    uint64_t emitted_triangles() const override { return emitted_; }
    std::string validate() const override;
    uint64_t memory_bytes() const override;

    const BlockGrid& blocks() const { return blocks_; }
    uint32_t rung(uint32_t block) const { return rung_[block]; }

  protected:
    LadderFront(const data::HeightGrid& grid, const BlockGrid& blocks);

    /// To be called once by the heir's constructor, when triangles_of works; all blocks stand on rung 0.
    void start(Ladders ladders);

    /// Triangles of a block next to its neighbours as they stand.
    virtual uint32_t triangles_of(uint32_t block) const = 0;
    /// The block has left rung `from`; returns elementary changes and counts them in `operations`.
    virtual uint32_t on_move(uint32_t block, uint32_t from, lod::OperationCounts& operations) = 0;

    uint32_t top_rung(uint32_t block) const { return ladders_.rung_count(block) - 1; }
    bool is_visible(uint32_t block) const { return sights_[block].is_visible(); }
    const GroundBox& box(uint32_t block) const { return boxes_[block]; }
    /// True once in each frame: for the first view's writes.
    bool take_first_view();
    void set_emitted(uint64_t triangles) { emitted_ = triangles; }

    const data::HeightGrid& grid_;

  private:
    double error_at_px(uint32_t block, uint32_t rung) const;
    double refine_key(uint32_t block) const;
    double coarsen_key(uint32_t block) const;
    uint64_t triangles_around(uint32_t block) const;
    lod::Step move(uint32_t block, uint32_t rung);

    BlockGrid blocks_;
    Ladders ladders_;
    std::vector<GroundBox> boxes_;  ///< [block]
    std::vector<Sight> sights_;     ///< [block] of this frame
    std::vector<uint16_t> rung_;    ///< [block]
    std::vector<lod::ViewMetric> views_;
    Ranking refine_, coarsen_;  ///< keys: pixels; of coarsen_ negated, so that the cheapest is on top
    uint64_t triangles_ = 0, emitted_ = 0;
    lod::OperationCounts operations_;
    bool is_first_view_ = true;
};

}  // namespace terrain
