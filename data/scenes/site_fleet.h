// The vehicles of the construction site: mixers, dumpers, flatbeds, excavators, each made of parts that move together.
#pragma once

#include "data/scenes/scene_builder.h"

namespace data::site {

/// All vehicles but the heaps on the dumpers.
/// @returns the key frames of the dumpers' beds, in which the heaps lie
std::vector<std::vector<KeyFrame>> add_fleet(SceneBuilder& builder);

}  // namespace data::site
