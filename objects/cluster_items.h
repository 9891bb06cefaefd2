// ClusterItems: turns clusters into draw items of one view.
#pragma once

#include "objects/facing_ranges.h"
#include "objects/scene_view.h"

namespace objects {

/// For one view and time. Geometry that lies in the scene's frame shares one instance.
class ClusterItems {
  public:
    ClusterItems(const ClusterTree& tree, const ScenePlace& place, const lod::PoolRegion& region,
                 const lod::View& view, double time_s)
        : tree_(tree), place_(place), region_(region), view_(view), sight_(view, place), time_s_(time_s) {}

    /// Appends the geometry of one cluster, if it has any: an item for each span of it that may show, and one for its
    /// glass.
    void add(ClusterId id, lod::DrawList& out);
    /// The same with all triangles, whichever way they look.
    void add_whole(ClusterId id, lod::DrawList& out);

    uint64_t triangles() const { return triangles_; }

  private:
    static constexpr uint32_t kNoInstance = 0xffffffffu;
    uint32_t instance_of(const Cluster& cluster, const data::ObjectPose& pose, lod::DrawList& out);
    void add_spans(const ClusterGeometry& geometry, uint32_t instance, lod::DrawList& out);

    const ClusterTree& tree_;
    const ScenePlace& place_;
    const lod::PoolRegion& region_;
    const lod::View& view_;
    SceneView sight_;
    double time_s_;
    uint32_t scene_instance_ = kNoInstance;
    std::vector<IndexSpan> spans_;  ///< scratch
    uint64_t triangles_ = 0;
};

}  // namespace objects
