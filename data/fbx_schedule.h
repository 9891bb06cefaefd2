// What Assimp leaves out of an FBX file: when its models are visible, and their curves as key frames.
#pragma once

#include <string>

#include "data/source_scene.h"
#include "lod/base/result.h"

namespace data {

/// Gives the objects of a source, read by Assimp from the same file, the visibility curves and the animated positions
/// and rotations of their models, by name; T is the stop of the file's animation. A model is there while it and those
/// above it are (Visibility, 0.5 and more; a value holds until the curve's next key). Places of models that do not move
/// keep Assimp's rounding unless the model stands right below the root, then they are the file's doubles.
/// Of an animated model the chain above it is followed with its own curves, at the times of all of their keys; rotations
/// are Euler angles about x, then y, then z. Pivots and other orders are not followed.
/// Fails on files that are no whole binary FBX; on text FBX only if it holds curves.
lod::Result<lod::Ok> add_fbx_schedule(const std::string& path, SourceScene& source);

}  // namespace data
