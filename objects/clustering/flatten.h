// Flattening: the draft's lists become the tree's arrays.
#pragma once

#include "objects/clustering/draft.h"

namespace objects {

/// Lays clusters out level by level from the root, siblings side by side; drops what is only needed for building.
/// @param root  the draft's top cluster; kNone: an empty scene
ClusterTree flatten(Draft& draft, uint32_t root);

}  // namespace objects
