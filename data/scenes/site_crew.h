// The people of the construction site: they come from their camp, walk to the tower, ride up, work storey by storey and leave.
#pragma once

#include "data/scenes/scene_builder.h"

namespace data::site {

void add_crew(int count, SceneBuilder& builder);

}  // namespace data::site
