// [[objects]] of a scene file: a cluster file, put where it belongs in the world, behind its front.
#pragma once

#include <memory>

#include "lod/base/result.h"
#include "objects/cluster_front.h"
#include "sim/world.h"

namespace sim {

/// Where a scene of objects stands.
///   on the Earth    at its own origin, east, north and up; the world must be the Earth then
///   anywhere else   where the scene file puts it: at `position` on the ground, turned by its heading; without a position
///                   at the origin of a world without datum
/// Fails with one line when the scene file and the cluster file do not agree.
lod::Result<objects::ScenePlace> place_of_site(const ObjectSource& source, const objects::ClusterTree& tree,
                                               const World& world);

/// Opens every cluster file of the scene. A scene of objects alone, none of them on the Earth, is a world without datum.
lod::Result<lod::Ok> build_sites(World& world);

}  // namespace sim
