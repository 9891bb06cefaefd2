#include "objects/cluster_items.h"

namespace objects {

uint32_t ClusterItems::instance_of(const Cluster& cluster, lod::DrawList& out) {
    const bool is_scene = cluster.motion == kSceneFrame;
    if (is_scene && scene_instance_ != kNoInstance) return scene_instance_;
    const data::ObjectPose pose = pose_of(tree_, cluster, time_s_);
    out.instances.push_back(lod::make_instance(
        view_.eye_world, view_.eye_from_world, place_.origin_world + place_.world_from_scene * pose.position,
        place_.world_from_scene * glm::mat3_cast(pose.rotation), lod::Module::kObjects));
    const auto index = static_cast<uint32_t>(out.instances.size() - 1);
    if (is_scene) scene_instance_ = index;
    return index;
}

void ClusterItems::add(ClusterId id, lod::DrawList& out) {
    const Cluster& cluster = tree_.clusters[id];
    if (cluster.geometry == kNoGeometry) return;
    const ClusterGeometry& geometry = tree_.geometries[cluster.geometry];
    if (geometry.index_count == 0) return;
    const uint32_t instance = instance_of(cluster, out);
    const uint32_t first = region_.first_index + geometry.first_index;
    const auto base = static_cast<int32_t>(region_.first_vertex + geometry.first_vertex);
    const uint32_t opaque = geometry.index_count - geometry.glass_index_count;
    if (opaque > 0) out.items.push_back({opaque, first, base, instance, false});
    if (geometry.glass_index_count > 0)
        out.items.push_back({geometry.glass_index_count, first + opaque, base, instance, true});
    triangles_ += geometry.index_count / 3;
}

}  // namespace objects
