// ProgressiveModel: a model's nodes, each with the vertex hierarchies of its geometry. What an .hpm file holds.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "lod/progressive/surface_mesh.h"
#include "lod/progressive/vertex_hierarchy.h"

namespace lod {

/// What moves as one: a case, a needle, a drum.
struct ProgressiveNode {
    std::string name;
    int32_t parent = -1;  ///< an earlier node, -1: a root
    glm::dmat4 parent_from_node{1.0};
};

/// Geometry of a node, all of it glass or none.
struct ProgressivePart {
    uint32_t node = 0;
    bool is_glass = false;
    MeshReport report;
    VertexHierarchy hierarchy;  ///< node frame
};

struct ProgressiveModel {
    glm::dmat4 file_from_model{1.0};     ///< to the axes of the file it was built from; rigid
    std::vector<ProgressiveNode> nodes;  ///< parents before children
    std::vector<ProgressivePart> parts;
};

/// Transforms of all nodes to the model: parents applied.
inline std::vector<glm::dmat4> model_from_nodes(const ProgressiveModel& model) {
    std::vector<glm::dmat4> transforms;
    for (const ProgressiveNode& node : model.nodes) {
        const bool is_root = node.parent < 0;
        transforms.push_back(is_root ? node.parent_from_node
                                     : transforms[static_cast<size_t>(node.parent)] * node.parent_from_node);
    }
    return transforms;
}

}  // namespace lod
