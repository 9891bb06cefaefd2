// Models and instruments of a scene: large ones adapt, small ones are drawn as they are.
#pragma once

#include "lod/base/result.h"
#include "sim/adaptive_models.h"
#include "sim/model_parts.h"
#include "sim/world.h"

namespace sim {

/// Smaller models are drawn whole: what adapting saves of them is less than it costs.
inline constexpr uint64_t kLeastAdaptiveTriangles = 2000;

/// Before they are fronts.
struct SceneModels {
    ModelParts rigid;
    AdaptiveModels adaptive;
};

/// Where a model stands on the ground as it is now.
lod::BodyPose standing_pose(const World& world, const ModelSource& source);

/// Reads all [[models]]: .hpm files as they are, others of some size are built into progressive meshes. Those that adapt
/// become World::models, the rest is added to `out.rigid`.
lod::Result<lod::Ok> add_models(World& world, const WorldOptions& options, SceneModels& out);

/// Reads all [[instruments]], likewise: World::panel, World::instruments, and what moves them.
lod::Result<lod::Ok> build_instruments(World& world, const WorldOptions& options);

}  // namespace sim
