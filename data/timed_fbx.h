// A TimedScene as binary FBX: geometry shared, visibility, position and rotation as animation curves.
//
// FBX counts time in ticks of 1/46186158000 s in 64 bits, so it ends at 199 million seconds; curves hold positions and
// angles as float32. Visibility is FBX's own property of a model: 1 there, 0 not, steps between.
#pragma once

#include <string>

#include "data/source_scene.h"
#include "data/timed_scene.h"
#include "lod/base/result.h"

namespace data {

/// The bytes of an FBX 7.4 file, z up, metres. An object that moves has curves for position and rotation (Euler angles,
/// linear between key frames), one that comes and goes a curve of steps. Deterministic.
/// Fails when a time is beyond what FBX can hold, or the file would be larger than 4 GiB.
lod::Result<std::string> timed_fbx_bytes(const TimedScene& scene);

}  // namespace data
