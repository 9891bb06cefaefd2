// EveryObject: a timed scene without levels of detail, behind lod::Front: each object that is there and in view, whole,
// one draw item each. What hierarchical dynamic levels of detail are compared with.
//
// Its geometry is the leaves' of a cluster tree, which the ClusterFront of the same tree writes; place both in one region.
#pragma once

#include <vector>

#include "lod/front.h"
#include "objects/presence.h"
#include "objects/scene_view.h"

namespace objects {

class EveryObject final : public lod::Front {
  public:
    /// @param tree  outlives the front
    EveryObject(const ClusterTree& tree, const ScenePlace& place);

    void begin_frame(std::span<const lod::View> views, double time_s) override;
    double refine_error_px() override { return 0.0; }
    double coarsen_error_px() override;
    lod::Step refine() override { return {}; }
    lod::Step coarsen(double) override { return {}; }
    uint64_t triangles() const override { return triangles_; }
    double error_px() override { return 0.0; }
    lod::OperationCounts operations() const override { return {}; }
    uint64_t hash() const override { return leaves_.size(); }
    lod::PoolRegion pool_need() const override;
    void place(const lod::PoolRegion& region) override { region_ = region; }
    void emit(const lod::View& view, lod::DrawList& out) override;
    uint64_t emitted_triangles() const override { return emitted_; }
    std::string validate() const override { return {}; }

  private:
    struct Leaf {
        ClusterId id = kNoCluster;
        Presence presence;
    };

    const ClusterTree& tree_;
    ScenePlace place_;
    std::vector<Leaf> leaves_;
    lod::PoolRegion region_;
    double time_s_ = 0.0;
    uint64_t triangles_ = 0, emitted_ = 0;
};

}  // namespace objects
