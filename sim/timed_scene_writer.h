// Writes a timed scene as files that others read: GLB with a schedule beside it, or FBX.
#pragma once

#include <string>
#include <vector>

#include "data/timed_scene.h"
#include "lod/base/result.h"

namespace sim {

/// The files that write_timed_scene will make for `out`: NAME.glb with NAME.csv; NAME.fbx alone; a name without
/// extension is a folder that gets scene.glb and scene.csv. Fails on other extensions.
lod::Result<std::vector<std::string>> timed_scene_files(const std::string& out);

/// Writes the scene to timed_scene_files(out); makes the folder where `out` is one.
lod::Result<lod::Ok> write_timed_scene(const data::TimedScene& scene, const std::string& out);

}  // namespace sim
