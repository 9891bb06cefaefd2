#include "objects/cluster_items.h"

namespace objects {

uint32_t ClusterItems::instance_of(const Cluster& cluster, const data::ObjectPose& pose, lod::DrawList& out) {
    const bool is_scene = cluster.motion == kSceneFrame;
    if (is_scene && scene_instance_ != kNoInstance) return scene_instance_;
    out.instances.push_back(lod::make_instance(
        view_.eye_world, view_.eye_from_world, place_.origin_world + place_.world_from_scene * pose.position,
        place_.world_from_scene * glm::mat3_cast(pose.rotation), lod::Module::kObjects));
    const auto index = static_cast<uint32_t>(out.instances.size() - 1);
    if (is_scene) scene_instance_ = index;
    return index;
}

void ClusterItems::add_spans(const ClusterGeometry& geometry, uint32_t instance, lod::DrawList& out) {
    const uint32_t first = region_.first_index + geometry.first_index;
    const auto base = static_cast<int32_t>(region_.first_vertex + geometry.first_vertex);
    for (const IndexSpan& span : spans_) {
        out.items.push_back({span.count, first + span.first, base, instance, false});
        triangles_ += span.count / 3;
    }
    const uint32_t glass = geometry.glass_index_count, opaque = geometry.index_count - glass;
    if (glass > 0) out.items.push_back({glass, first + opaque, base, instance, true});
    triangles_ += glass / 3;
}

void ClusterItems::add(ClusterId id, lod::DrawList& out) {
    const Cluster& cluster = tree_.clusters[id];
    if (cluster.geometry == kNoGeometry) return;
    const ClusterGeometry& geometry = tree_.geometries[cluster.geometry];
    const data::ObjectPose pose = pose_of(tree_, cluster, time_s_);
    spans_.clear();
    visible_spans(tree_, geometry, glm::conjugate(pose.rotation) * (sight_.eye_scene - pose.position),
                  sight_.metric.near_m * sight_.metric.stretch, spans_);
    if (!spans_.empty() || geometry.glass_index_count > 0)
        add_spans(geometry, instance_of(cluster, pose, out), out);
}

void ClusterItems::add_whole(ClusterId id, lod::DrawList& out) {
    const Cluster& cluster = tree_.clusters[id];
    if (cluster.geometry == kNoGeometry) return;
    const ClusterGeometry& geometry = tree_.geometries[cluster.geometry];
    if (geometry.index_count == 0) return;
    spans_.clear();
    if (geometry.index_count > geometry.glass_index_count)
        spans_.push_back({0, geometry.index_count - geometry.glass_index_count});
    add_spans(geometry, instance_of(cluster, pose_of(tree_, cluster, time_s_), out), out);
}

}  // namespace objects
