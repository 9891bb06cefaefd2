// SceneView: one eye before a timed scene, and how many pixels a cluster's error can cost there.
//
// DISPLAY (display.h) and the front (cluster_front.h) both see through it, so that they agree to the bit.
#pragma once

#include <array>
#include <span>

#include "data/scene_time.h"
#include "lod/screen_error.h"
#include "objects/cluster_tree.h"

namespace objects {

/// Where the scene's frame stands in the world: a rotation and a place, metres.
struct ScenePlace {
    glm::dmat3 world_from_scene{1.0};
    glm::dvec3 origin_world{0.0};
};

/// A view, prepared for loops over clusters; eye and directions in the scene frame.
struct SceneView {
    SceneView(const lod::View& view, const ScenePlace& place);

    lod::ViewMetric metric;
    glm::dmat3 eye_from_scene;
    glm::dvec3 eye_scene;
};

/// A sphere in the scene frame, metres.
struct SceneSphere {
    glm::dvec3 centre{0.0};
    double radius_m = 0.0;
};

/// Where a cluster is at a time: its own sphere, or where its motion has carried it.
/// Cost: that of one binary search and an arc for a cluster that moves, else none.
SceneSphere sphere_at(const ClusterTree& tree, const Cluster& cluster, double time_s);

/// Corners of a box, in the eye frame, that holds all that a cluster may draw or stand for at a time.
lod::EyeBox box_in_eye(const ClusterTree& tree, const Cluster& cluster, const SceneView& sight,
                       double time_s);

/// What an eye sees of a box in its frame.
struct ClusterSight {
    bool is_seen = false;   ///< some of the box may be in the picture
    double error_px = 0.0;  ///< what the error can cost; 0 unless seen; finite
};
/// @param error_m  of what is in the box, >= 0
ClusterSight sight_of(const SceneView& view, const lod::EyeBox& box, double error_m);

/// Pose of a cluster's geometry; the scene frame itself for one that has no motion.
data::ObjectPose pose_of(const ClusterTree& tree, const Cluster& cluster, double time_s);

}  // namespace objects
