#include "sim/adaptive_models.h"

#include <utility>

#include "lod/base/check.h"
#include "lod/progressive/transform_hierarchy.h"

namespace sim {

/// Meshes of all parts in the frames of their bodies; which those are depends on what the drives move.
uint32_t AdaptiveModels::meshes_of(Known& known, const ModelBodies& bodies, std::span<const Drive> drives) {
    std::string moved;
    for (const Drive& drive : drives)
        moved += drive.node + "\n";
    const auto [place, is_new] = known.first_mesh.try_emplace(moved, static_cast<uint32_t>(meshes_.size()));
    if (!is_new) return place->second;
    for (const lod::ProgressivePart& part : known.model.parts) {
        lod::VertexHierarchy hierarchy = part.hierarchy;
        lod::transform_hierarchy(hierarchy, bodies.body_from_node[part.node]);
        meshes_.push_back(lod::make_progressive_mesh(std::move(hierarchy), part.is_glass));
    }
    return place->second;
}

lod::Result<lod::Ok> AdaptiveModels::add(const std::string& key, const lod::BodyPose& placement,
                                         std::span<const Drive> drives) {
    CHECK(knows(key));
    Known& known = known_[key];
    std::vector<ModelNode> nodes;
    for (const lod::ProgressiveNode& node : known.model.nodes)
        nodes.push_back({node.name, node.parent, node.parent_from_node});
    lod::Result<ModelBodies> bodies = make_model_bodies(nodes, placement, drives);
    if (!bodies) return bodies.error();
    const uint32_t first_mesh = meshes_of(known, *bodies, drives);
    const auto first_pose = static_cast<uint32_t>(rig_.poses.size());
    for (uint32_t part = 0; part < known.model.parts.size(); ++part) {
        const uint32_t body = bodies->body_of_node[known.model.parts[part].node];
        placements_.push_back({first_mesh + part, bodies->bodies[body]});
        rig_.pose_of_body.push_back(first_pose + body);
    }
    rig_.poses.insert(rig_.poses.end(), bodies->bodies.begin(), bodies->bodies.end());
    for (MovingBody moving : bodies->moving) {
        moving.body += first_pose;
        moving.parent += first_pose;
        rig_.moving.push_back(moving);
    }
    return lod::Ok{};
}

std::unique_ptr<lod::MeshFront> AdaptiveModels::make_front(lod::Module module,
                                                           const lod::MeshOptions& options,
                                                           AdaptiveRig& rig) {
    known_.clear();
    rig = std::move(rig_);
    return std::make_unique<lod::MeshFront>(module, std::move(meshes_), placements_, options);
}

void pose_bodies(const AdaptiveRig& rig, const glm::dmat3& turn, const glm::dvec3& shift_m,
                 lod::MeshFront& front) {
    for (uint32_t body = 0; body < rig.pose_of_body.size(); ++body) {
        lod::BodyPose pose = rig.poses[rig.pose_of_body[body]];
        pose.reference_from_body = turn * pose.reference_from_body;
        pose.origin = turn * (pose.origin - shift_m);
        front.set_pose(body, pose);
    }
}

}  // namespace sim
