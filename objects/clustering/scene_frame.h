// What stands still and is drawn by one cluster alone lies in the scene frame: one pose less to look up, and one draw for
// all of its kind.
#pragma once

#include "objects/clustering/draft.h"

namespace objects {

/// Moves geometry of the tree that a single cluster uses, and whose motion is one pose for ever, to where it stands. The
/// cluster has no motion then. Shared geometry stays shared.
/// @param draft  whose motions the clusters name
void put_in_scene_frame(const Draft& draft, ClusterTree& tree);

}  // namespace objects
