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

std::array<glm::dvec3, 8> box_in_eye(const ClusterTree& tree, const Cluster& cluster, const SceneView& sight,
                                     double time_s) {
    // Its own geometry may stick out of the box of what it stands for.
    const double margin_m = cluster.geometry == kNoGeometry ? 0.0 : double(cluster.error_m);
    const glm::dvec3 low = glm::dvec3(cluster.box_min) - margin_m,
                     high = glm::dvec3(cluster.box_max) + margin_m;
    const bool moves = cluster.motion != kSceneFrame && tree.motions[cluster.motion].size() > 1;
    const data::ObjectPose pose = moves ? pose_of(tree, cluster, time_s) : data::ObjectPose{};
    const glm::dmat3 eye_from_box = sight.eye_from_scene * glm::mat3_cast(pose.rotation);
    const glm::dvec3 first = eye_from_box * low + sight.eye_from_scene * (pose.position - sight.eye_scene);
    const glm::dvec3 extent = high - low;
    std::array<glm::dvec3, 8> corners;
    for (size_t i = 0; i < corners.size(); ++i) {
        corners[i] = first;
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            if ((i >> axis & 1) != 0) corners[i] += eye_from_box[axis] * extent[axis];
        }
    }
    return corners;
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
