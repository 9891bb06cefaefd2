// Vdpm: a view-dependent progressive mesh over the whole height field, the code of instruments (lod/progressive).
//
// Vertices of all levels are samples: an edge collapses into one of its ends. So the ground is coloured and lit as
// with every other method. The hierarchy is built over ground that is pressed flat: its errors are vertical ones.
// Sources: Hoppe (1997, 1998); Elykov, Lavrentiev et al. (Softlab-NSK), section 4.4.
#pragma once

#include <memory>

#include "lod/progressive/mesh_front.h"
#include "terrain/rivals/ground_vertex.h"
#include "terrain/rivals/rival_front.h"

namespace terrain {

class Vdpm final : public RivalFront {
  public:
    /// Larger rasters take minutes and gigabytes.
    static constexpr size_t kMostSamples = size_t{1025} * 1025;

    /// @param grid          must outlive the front; at most kMostSamples
    /// @param tolerance_px  what the scheduler will ask for
    /// Cost: about 25 us a sample.
    Vdpm(const data::HeightGrid& grid, double tolerance_px);

    void begin_frame(std::span<const lod::View> views, double time_s) override;
    double refine_error_px() override { return front_->refine_error_px(); }
    double coarsen_error_px() override { return front_->coarsen_error_px(); }
    lod::Step refine() override { return front_->refine(); }
    lod::Step coarsen(double limit_px) override { return front_->coarsen(limit_px); }
    uint64_t triangles() const override { return front_->triangles(); }
    double error_px() override { return front_->error_px(); }
    double jump_px() const override { return front_->jump_px(); }
    lod::OperationCounts operations() const override { return front_->operations(); }
    uint64_t hash() const override { return front_->hash(); }
    lod::PoolRegion pool_need() const override { return front_->pool_need(); }
    void place(const lod::PoolRegion& region) override;
    void emit(const lod::View& view, lod::DrawList& out) override;
    uint64_t emitted_triangles() const override { return front_->emitted_triangles(); }
    std::string validate() const override { return front_->validate(); }
    uint64_t memory_bytes() const override { return memory_bytes_; }

  private:
    const data::HeightGrid& grid_;
    std::vector<uint32_t> sample_of_;  ///< [vertices of the hierarchy] index into the grid
    std::unique_ptr<lod::MeshFront> front_;
    uint64_t memory_bytes_ = 0;
    lod::PoolRegion region_;
    StaticVertices vertices_;
    bool is_first_view_ = true;
    lod::DrawList mesh_list_;  ///< what the mesh front emits; its vertices are not the ground's
};

}  // namespace terrain
