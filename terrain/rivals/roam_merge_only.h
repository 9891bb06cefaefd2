// RoamMergeOnly: ROAM with the operations of 1997, split and merge, as enhMerge's authors found it.
//
// Going back to a coarser mesh is a sequence of single merges: after a cut or a fast turn every one of them is
// paid for. Everything else is RoamFront's.
// Sources: Duchaineau et al., ROAMing Terrain (1997); Elykov, Lavrentiev et al. (Softlab-NSK), section 5.2.
#pragma once

#include "terrain/rivals/rival_front.h"
#include "terrain/roam_front.h"

namespace terrain {

class RoamMergeOnly final : public RivalFront {
  public:
    /// @param tolerance_px  what the scheduler will ask for
    RoamMergeOnly(DiamondTable table, double tolerance_px)
        : front_(std::move(table), options_for(tolerance_px)) {}

    void begin_frame(std::span<const lod::View> views, double time_s) override {
        front_.begin_frame(views, time_s);
    }
    double refine_error_px() override { return front_.refine_error_px(); }
    double coarsen_error_px() override { return front_.coarsen_error_px(); }
    lod::Step refine() override { return front_.refine(); }
    lod::Step coarsen(double limit_px) override { return front_.coarsen(limit_px); }
    uint64_t triangles() const override { return front_.triangles(); }
    double error_px() override { return front_.error_px(); }
    lod::OperationCounts operations() const override { return front_.operations(); }
    uint64_t hash() const override { return front_.hash(); }
    lod::PoolRegion pool_need() const override { return front_.pool_need(); }
    void place(const lod::PoolRegion& region) override { front_.place(region); }
    void emit(const lod::View& view, lod::DrawList& out) override { front_.emit(view, out); }
    double jump_px() const override { return front_.jump_px(); }
    uint64_t emitted_triangles() const override { return front_.emitted_triangles(); }
    std::string validate() const override { return front_.validate(); }
    uint64_t memory_bytes() const override {
        return front_.memory_bytes() + front_.table().slots.size() * sizeof(DiamondSource);
    }

  private:
    static RoamOptions options_for(double tolerance_px) {
        RoamOptions options;
        options.tolerance_px = tolerance_px;
        options.is_pruning = false;
        return options;
    }

    RoamFront front_;
};

}  // namespace terrain
