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

lod::EyeBox box_in_eye(const ClusterTree& tree, const Cluster& cluster, const SceneView& sight,
                       double time_s) {
    // Its own geometry may stick out of the box of what it stands for.
    const double margin_m = cluster.geometry == kNoGeometry ? 0.0 : double(cluster.error_m);
    const glm::dvec3 low = glm::dvec3(cluster.box_min) - margin_m,
                     high = glm::dvec3(cluster.box_max) + margin_m;
    glm::dmat3 eye_from_box = sight.eye_from_scene;
    glm::dvec3 origin_scene(0.0);
    if (cluster.motion != kSceneFrame && tree.motions[cluster.motion].size() > 1) {
        const data::ObjectPose pose = pose_of(tree, cluster, time_s);
        eye_from_box = eye_from_box * glm::mat3_cast(pose.rotation);
        origin_scene = pose.position;
    }
    const glm::dvec3 extent = high - low;
    lod::EyeBox corners;
    corners[0] = eye_from_box * low + sight.eye_from_scene * (origin_scene - sight.eye_scene);
    for (size_t axis = 0; axis < 3; ++axis) {
        const auto column = static_cast<glm::length_t>(axis);
        const glm::dvec3 across = eye_from_box[column] * extent[column];
        for (size_t i = 0; i < size_t{1} << axis; ++i)
            corners[i + (size_t{1} << axis)] = corners[i] + across;
    }
    return corners;
}

ClusterSight sight_of(const SceneView& view, const lod::EyeBox& box, double error_m) {
    if (lod::is_outside(view.metric, box)) return {};
    return {true, lod::screen_error_px(view.metric, box, error_m)};
}

}  // namespace objects
