// ModelBodies: which nodes of a model move together, and how each lies in the body that carries it.
//
// Body 0 is everything that does not move. Every node named by a drive becomes a body of its own and carries its
// descendants. A body's frame has the node's origin and its axes made orthonormal (z kept); whatever scale or shear the
// file put into its nodes is left to body_from_node.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "lod/base/result.h"
#include "lod/body_pose.h"
#include "sim/model_pose.h"
#include "sim/scene_file.h"

namespace sim {

/// What a model file says of a node.
struct ModelNode {
    std::string name;
    int parent = -1;  ///< an earlier node, -1: a root
    glm::dmat4 parent_from_node{1.0};
};

struct ModelBodies {
    std::vector<lod::BodyPose> bodies;       ///< at signal 0; [0] is the model's placement
    std::vector<MovingBody> moving;          ///< parents before children
    std::vector<uint32_t> body_of_node;      ///< [nodes]
    std::vector<glm::dmat4> body_from_node;  ///< [nodes]
};

/// @param drives  a node's name ends in _N, N the units of its signal per full turn (needle_1000), not zero
/// Fails, naming the node, when a drive's node is missing or its name has no such ending.
lod::Result<ModelBodies> make_model_bodies(std::span<const ModelNode> nodes, const lod::BodyPose& placement,
                                           std::span<const Drive> drives);

}  // namespace sim
