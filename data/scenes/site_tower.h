// The tower of the construction site: what is erected in every storey, and its crown.
#pragma once

#include "data/scenes/scene_builder.h"

namespace data::site {

/// Two storeys of structure below ground, 57 storeys with all their trades, the roof, its screen and a spire.
void add_tower(SceneBuilder& builder);

}  // namespace data::site
