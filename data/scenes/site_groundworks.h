// What is built around the tower: pit, piles, raft, the plaza's slabs, masts, a podium with its scaffold, trees.
#pragma once

#include "data/scenes/scene_builder.h"

namespace data::site {

void add_groundworks(SceneBuilder& builder);

/// The masts of the four cranes, which grow with the tower, and of its two hoists.
void add_masts(SceneBuilder& builder);

/// Two storeys south of the tower, begun when the crane there is gone.
void add_podium(SceneBuilder& builder);

void add_trees(SceneBuilder& builder);

}  // namespace data::site
