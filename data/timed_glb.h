// A TimedScene as one GLB: every mesh once, every object a node with its first pose. The schedule goes beside it
// (data/schedule_csv.h).
#pragma once

#include <vector>

#include "data/timed_scene.h"

namespace data {

/// The scene as the bytes of a GLB: one root that turns z up to glTF's y up, below it a node for every object, named by
/// its id; colours as vertex colours (COLOR_0, 16 bits, linear). Objects whose mesh has no triangles are nodes without
/// a mesh. Deterministic.
/// Source: Khronos glTF 2.0 specification, sections 3 and 4.
std::vector<char> timed_glb_bytes(const TimedScene& scene);

}  // namespace data
