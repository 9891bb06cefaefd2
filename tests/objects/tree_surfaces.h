// What a cluster of a built tree stands for, straight from the scene, and what it draws.
#pragma once

#include <vector>

#include "data/scene_time.h"
#include "objects/clustering/cluster_build.h"
#include "objects/reduction/face_soup.h"

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

/// Triangles of leaves straight from the scene, each where its object stands while the leaf is there; in the body frame
/// for bodies that move.
inline objects::FaceSoup source_surface(const data::TimedScene& scene, const objects::ClusterTree& tree,
                                        const std::vector<objects::ClusterId>& leaves, bool in_body_frame) {
    objects::FaceSoup out;
    for (objects::ClusterId id : leaves) {
        const data::TimedObject& object = scene.objects[tree.clusters[id].object];
        const data::ObjectPose pose = data::pose_at(scene, object, time_of(tree, tree.clusters[id]));
        const data::TimedMesh& mesh = scene.meshes[object.mesh];
        objects::FaceSoup soup;
        for (const glm::vec3& p : mesh.positions)
            soup.points.emplace_back(p);
        soup.faces = mesh.triangles;
        soup.colours.resize(mesh.triangles.size());
        if (in_body_frame)
            objects::append_soup(soup, glm::dmat3(1.0), glm::dvec3(0.0), out);
        else
            objects::append_soup(soup, glm::mat3_cast(pose.rotation), pose.position, out);
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
