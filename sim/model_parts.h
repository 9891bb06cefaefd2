// ModelParts: a polygon mesh as bodies and parts for a RigidFront.
//
// Whatever scale or shear the file put into its nodes (model_bodies.h) is worked into the vertices.
#pragma once

#include <span>
#include <vector>

#include "data/polygon_mesh.h"
#include "lod/base/result.h"
#include "lod/rigid_front.h"
#include "sim/model_pose.h"
#include "sim/scene_file.h"

namespace sim {

struct ModelParts {
    std::vector<lod::RigidPart> parts;
    std::vector<lod::BodyPose> bodies;  ///< at signal 0; [0] is the model's placement
    std::vector<MovingBody> moving;     ///< parents before children
};

/// Turns a mesh into parts of at most some thousand triangles. Opacity below 0.5 makes a glass part
/// (Material::kGlass), emission above 0.5 Material::kGlow, all else Material::kPaint.
///
/// @param drives  a node's name ends in _N, N the units of its signal per full turn (needle_1000), not zero
/// Fails, naming the node, when a drive's node is missing or its name has no such ending.
lod::Result<ModelParts> make_model_parts(const data::PolygonMesh& mesh, const lod::BodyPose& placement,
                                         std::span<const Drive> drives);

/// Appends one model to another, so that one front draws both.
void append_model(const ModelParts& model, ModelParts& to);

}  // namespace sim
