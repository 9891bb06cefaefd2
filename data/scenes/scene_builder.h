// SceneBuilder: appends meshes and objects of a generated scene, each with a placement and a time.
#pragma once

#include <string>
#include <vector>

#include "data/scenes/solids.h"
#include "data/timed_scene.h"
#include "lod/base/rng.h"

namespace data {

/// Upright at a place: turned about +z.
struct Placement {
    glm::dvec3 position{0.0};
    double turn_rad = 0.0;  ///< counter-clockwise seen from above
};

/// p_outer after p_inner: where something stands that stands in something else.
Placement operator*(const Placement& outer, const Placement& inner);

/// From when to when. The defaults are for ever.
struct Presence {
    static constexpr double kNever = -1.0;

    double appears_s = kNever;     ///< kNever: it is there from the beginning
    double disappears_s = kNever;  ///< kNever: it stays
};

struct SceneBuilder {
    TimedScene scene;
    lod::Rng rng;

    explicit SceneBuilder(uint64_t seed) : rng(seed) {}
};

uint32_t add_mesh(TimedMesh mesh, SceneBuilder& builder);

/// An object that does not move. Its id is `kind` and its number in the scene.
void add_object(const std::string& kind, uint32_t mesh, const Placement& placement, const Presence& presence,
                SceneBuilder& builder);

/// An object with key frames, times not falling.
void add_mover(const std::string& kind, uint32_t mesh, const std::vector<KeyFrame>& keys,
               const Presence& presence, SceneBuilder& builder);

KeyFrame key_at(double time_s, const Placement& placement);

}  // namespace data
