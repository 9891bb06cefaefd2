// AdaptiveModels: progressive models as bodies for one MeshFront: every part of every node follows its node.
//
// One source is read or built once, however often it stands in the scene; its meshes are shared.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "data/polygon_mesh.h"
#include "lod/base/result.h"
#include "lod/progressive/mesh_front.h"
#include "lod/progressive/progressive_model.h"
#include "sim/model_bodies.h"

namespace sim {

/// What moves a MeshFront's bodies.
struct AdaptiveRig {
    std::vector<MovingBody> moving;      ///< parents before children
    std::vector<lod::BodyPose> poses;    ///< needles where the last signals put them
    std::vector<uint32_t> pose_of_body;  ///< [bodies of the front] into poses
};

class AdaptiveModels {
  public:
    bool is_empty() const { return placements_.empty(); }
    /// Poses of all models so far; the next one's placement comes at this index.
    uint32_t pose_count() const { return static_cast<uint32_t>(rig_.poses.size()); }

    /// Whether a source is known by its key.
    bool knows(const std::string& key) const { return known_.contains(key); }
    void learn(const std::string& key, lod::ProgressiveModel model) { known_[key].model = std::move(model); }

    /// Adds a known model that stands at `placement`, with the parts that its drives move.
    /// Fails as make_model_bodies does.
    lod::Result<lod::Ok> add(const std::string& key, const lod::BodyPose& placement,
                             std::span<const Drive> drives);

    /// The front of all that was added, and what moves it. The models are spent.
    std::unique_ptr<lod::MeshFront> make_front(lod::Module module, const lod::MeshOptions& options,
                                               AdaptiveRig& rig);

  private:
    struct Known {
        lod::ProgressiveModel model;
        std::map<std::string, uint32_t> first_mesh;  ///< by the nodes that drives move: meshes of its parts
    };
    uint32_t meshes_of(Known& known, const ModelBodies& bodies, std::span<const Drive> drives);

    std::map<std::string, Known> known_;
    std::vector<lod::ProgressiveMesh> meshes_;
    std::vector<lod::MeshPlacement> placements_;
    AdaptiveRig rig_;
};

/// Moves the front's bodies to the rig's poses, in the order of `rig.pose_of_body`.
/// @param turn, shift_m  every pose is seen from a head that has moved by shift and turned (eye frame)
void pose_bodies(const AdaptiveRig& rig, const glm::dmat3& turn, const glm::dvec3& shift_m,
                 lod::MeshFront& front);

}  // namespace sim
