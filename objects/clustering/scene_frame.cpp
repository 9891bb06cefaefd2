#include "objects/clustering/scene_frame.h"

namespace objects {

namespace {

constexpr double kSlackShare = 1e-6;  ///< of coordinates: what rounding to single precision may move

std::vector<uint32_t> users_of_geometries(const ClusterTree& tree) {
    std::vector<uint32_t> users(tree.geometries.size(), 0);
    for (const Cluster& cluster : tree.clusters) {
        if (cluster.geometry != kNoGeometry) ++users[cluster.geometry];
    }
    return users;
}

void move_geometry(const data::ObjectPose& pose, ClusterGeometry& geometry, ClusterTree& tree) {
    const glm::dmat3 turn = glm::mat3_cast(pose.rotation);
    for (lod::Vertex& vertex :
         std::span(tree.vertices).subspan(geometry.first_vertex, geometry.vertex_count)) {
        lod::split_hi_lo(turn * lod::position_of(vertex) + pose.position, vertex.position_hi,
                         vertex.position_lo);
        lod::encode_normal(glm::vec3(turn * glm::dvec3(lod::decode_normal(vertex.surface))), vertex.surface);
    }
    const glm::dvec3 centre = turn * glm::dvec3(geometry.centre) + pose.position;
    const double slack_m = kSlackShare * glm::length(centre);
    geometry.centre = glm::vec3(centre);
    if (geometry.facing_count == 0) return;
    geometry.radius_m = static_cast<float>((double(geometry.radius_m) + slack_m) * (1.0 + kSlackShare));
    for (FacingRange& range : std::span(tree.facings).subspan(geometry.first_facing, geometry.facing_count)) {
        range.axis = glm::vec3(turn * glm::dvec3(range.axis));
        range.least_offset_m -= static_cast<float>(slack_m);
    }
}

}  // namespace

void put_in_scene_frame(const Draft& draft, ClusterTree& tree) {
    const std::vector<uint32_t> users = users_of_geometries(tree);
    for (Cluster& cluster : tree.clusters) {
        if (cluster.geometry == kNoGeometry || cluster.motion == kSceneFrame) continue;
        const data::IndexRange motion = draft.motions[cluster.motion];
        if (motion.size() != 1 || users[cluster.geometry] != 1) continue;
        const data::KeyFrame& key = draft.scene.keys[motion.begin];
        move_geometry({key.position, key.rotation}, tree.geometries[cluster.geometry], tree);
        cluster.motion = kSceneFrame;
    }
}

}  // namespace objects
