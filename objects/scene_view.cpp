#include "objects/scene_view.h"

#include <algorithm>

namespace objects {

SceneView::SceneView(const lod::View& view, const ScenePlace& place)
    : metric(lod::metric_of(view)),
      eye_from_scene(view.eye_from_world * place.world_from_scene),
      eye_scene(glm::transpose(place.world_from_scene) * (view.eye_world - place.origin_world)) {}

data::ObjectPose pose_of(const ClusterTree& tree, const Cluster& cluster, double time_s) {
    if (cluster.motion == kSceneFrame) return {};
    const data::IndexRange range = tree.motions[cluster.motion];
    return data::pose_between(std::span(tree.keys).subspan(range.begin, range.size()), time_s);
}

SceneSphere sphere_at(const ClusterTree& tree, const Cluster& cluster, double time_s) {
    const SceneSphere own{glm::dvec3(cluster.centre), double(cluster.radius_m)};
    if (cluster.motion == kSceneFrame || tree.motions[cluster.motion].size() < 2) return own;
    const data::ObjectPose pose = pose_of(tree, cluster, time_s);
    // The rotation is a unit quaternion but for rounding.
    return {pose.position + pose.rotation * own.centre, own.radius_m * (1.0 + 1e-12)};
}

ClusterSight sight_of(std::span<const SceneView> views, const SceneSphere& sphere, double error_m) {
    ClusterSight sight;
    for (const SceneView& view : views) {
        const glm::dvec3 centre_eye = view.eye_from_scene * (sphere.centre - view.eye_scene);
        if (lod::distance_outside_m(view.metric, centre_eye, sphere.radius_m) > 0.0) continue;
        sight.is_seen = true;
        sight.error_px =
            std::max(sight.error_px, lod::screen_error_px(view.metric, centre_eye, sphere.radius_m, error_m));
    }
    return sight;
}

}  // namespace objects
