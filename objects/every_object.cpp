#include "objects/every_object.h"

#include <limits>

#include "objects/cluster_items.h"

namespace objects {

EveryObject::EveryObject(const ClusterTree& tree, const ScenePlace& place) : tree_(tree), place_(place) {
    for (ClusterId id = 0; id < tree.clusters.size(); ++id) {
        if (tree.is_leaf(id)) leaves_.push_back({id, {0.0, 1.0, 0.0}});  // an empty span: looked up at once
    }
}

double EveryObject::coarsen_error_px() {
    return std::numeric_limits<double>::infinity();
}

void EveryObject::begin_frame(std::span<const lod::View>, double time_s) {
    time_s_ = clamped_time(tree_, time_s);
    triangles_ = 0;
    for (Leaf& leaf : leaves_) {
        const Cluster& cluster = tree_.clusters[leaf.id];
        if (!leaf.presence.holds_at(time_s_)) leaf.presence = presence_at(tree_, cluster.visibility, time_s_);
        if (leaf.presence.share > 0.0 && cluster.geometry != kNoGeometry)
            triangles_ += tree_.geometries[cluster.geometry].index_count / 3;
    }
}

lod::PoolRegion EveryObject::pool_need() const {
    return {0, static_cast<uint32_t>(tree_.vertices.size()), 0, static_cast<uint32_t>(tree_.indices.size())};
}

void EveryObject::emit(const lod::View& view, lod::DrawList& out) {
    const SceneView sight(view, place_);
    ClusterItems items(tree_, place_, region_, view, time_s_);
    for (const Leaf& leaf : leaves_) {
        if (leaf.presence.share <= 0.0) continue;
        if (!lod::is_outside(sight.metric, box_in_eye(tree_, tree_.clusters[leaf.id], sight, time_s_)))
            items.add_whole(leaf.id, out);
    }
    emitted_ = items.triangles();
}

}  // namespace objects
