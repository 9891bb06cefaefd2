// What stands around the construction site all the time: ground, roads, the neighbourhood, huts, trees, lamps.
#pragma once

#include "data/scenes/scene_builder.h"

namespace data::site {

void add_surroundings(SceneBuilder& builder);

}  // namespace data::site
