// What a cluster of a built tree stands for, straight from the scene, and what it draws.
#pragma once

#include <vector>

#include "data/scene_time.h"
#include "objects/clustering/cluster_build.h"
#include "objects/reduction/face_soup.h"
#include "objects/scene_view.h"

namespace objects_test {

inline objects::ClusterTree build(const data::TimedScene& scene, unsigned threads = 2) {
    objects::BuildOptions options;
    options.threads = threads;
    return objects::build_cluster_tree(scene, options);
}

/// Leaves below a cluster.
inline void gather_leaves(const objects::ClusterTree& tree, objects::ClusterId id,
                          std::vector<objects::ClusterId>& out) {
    const objects::Cluster& c = tree.clusters[id];
    if (c.child_count == 0) out.push_back(id);
    for (uint32_t i = 0; i < c.child_count; ++i)
        gather_leaves(tree, c.first_child + i, out);
}

/// A time at which a leaf is there; 0 if it never is.
inline double time_of(const objects::ClusterTree& tree, const objects::Cluster& leaf) {
    const data::IndexRange steps = tree.visibilities[leaf.visibility];
    for (uint32_t i = steps.begin; i < steps.end; ++i) {
        if (tree.step_value[i] == 1.0) return tree.step_time_s[i];
    }
    return 0.0;
}

/// A time at which something of a cluster is there: `share` of the way through all such times; 0 if it never is.
inline double time_there(const objects::ClusterTree& tree, const objects::Cluster& cluster, double share) {
    const data::IndexRange steps = tree.visibilities[cluster.visibility];
    const auto end_of = [&](uint32_t i) { return i + 1 < steps.end ? tree.step_time_s[i + 1] : tree.end_s; };
    double total_s = 0.0;
    for (uint32_t i = steps.begin; i < steps.end; ++i)
        total_s += tree.step_value[i] > 0.0 ? end_of(i) - tree.step_time_s[i] : 0.0;
    double left_s = share * total_s;
    for (uint32_t i = steps.begin; i < steps.end; ++i) {
        if (!(tree.step_value[i] > 0.0)) continue;
        const double length_s = end_of(i) - tree.step_time_s[i];
        if (left_s < length_s) return tree.step_time_s[i] + left_s;
        left_s -= length_s;
    }
    return 0.0;
}

/// Triangles of everything below a cluster straight from the scene, each where its object stands while its leaf is there; of
/// a cluster that moves, in its frame, as they stand when `share` of the time is over in which it is there.
inline objects::FaceSoup source_surface(const data::TimedScene& scene, const objects::ClusterTree& tree,
                                        objects::ClusterId id, double share = 0.0) {
    std::vector<objects::ClusterId> leaves;
    gather_leaves(tree, id, leaves);
    const bool moves = tree.moves(id);
    const double frame_time_s = time_there(tree, tree.clusters[id], share);
    const data::ObjectPose frame =
        moves ? objects::pose_of(tree, tree.clusters[id], frame_time_s) : data::ObjectPose{};
    const glm::dquat back = glm::conjugate(frame.rotation);
    objects::FaceSoup out;
    for (objects::ClusterId leaf : leaves) {
        const data::TimedObject& object = scene.objects[tree.clusters[leaf].object];
        const data::ObjectPose pose =
            data::pose_at(scene, object, moves ? frame_time_s : time_of(tree, tree.clusters[leaf]));
        const data::TimedMesh& mesh = scene.meshes[object.mesh];
        objects::FaceSoup soup;
        for (const glm::vec3& p : mesh.positions)
            soup.points.emplace_back(p);
        soup.faces = mesh.triangles;
        soup.colours.resize(mesh.triangles.size());
        objects::append_soup(soup, glm::mat3_cast(back * pose.rotation),
                             back * (pose.position - frame.position), out);
    }
    return out;
}

/// Triangles a cluster draws, in the frame of source_surface.
inline objects::FaceSoup drawn_surface(const objects::ClusterTree& tree, const objects::Cluster& c) {
    const objects::ClusterGeometry& g = tree.geometries[c.geometry];
    objects::FaceSoup soup;
    for (uint32_t i = 0; i < g.vertex_count; ++i)
        soup.points.push_back(lod::position_of(tree.vertices[g.first_vertex + i]));
    for (uint32_t i = 0; i + 2 < g.index_count; i += 3) {
        const uint32_t* corner = &tree.indices[g.first_index + i];
        soup.faces.push_back({corner[0], corner[1], corner[2]});
    }
    soup.colours.resize(soup.faces.size());
    if (c.motion == objects::kSceneFrame || tree.motions[c.motion].size() > 1) return soup;
    const data::KeyFrame& key = tree.keys[tree.motions[c.motion].begin];
    objects::FaceSoup placed;
    objects::append_soup(soup, glm::mat3_cast(key.rotation), key.position, placed);
    return placed;
}

}  // namespace objects_test
