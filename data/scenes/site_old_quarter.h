// The houses that stood where the tower will: they are there at first, and pulled down one after the other.
#pragma once

#include "data/scenes/scene_builder.h"

namespace data::site {

/// 86 houses of 79 parts, 5,592 triangles each; the last is gone when the pit is begun.
void add_old_quarter(SceneBuilder& builder);

}  // namespace data::site
