// The vehicles of the construction site: mixers, dumpers, flatbeds, excavators, each made of parts that move together.
#pragma once

#include "data/scenes/scene_builder.h"

namespace data::site {

/// Where a dumper's load lies, and while it is there.
struct Bed {
    std::vector<KeyFrame> keys;
    Presence presence;
};

/// All vehicles but the loads of the dumpers. Each comes to its parking place, does one round and leaves.
std::vector<Bed> add_fleet(SceneBuilder& builder);

}  // namespace data::site
