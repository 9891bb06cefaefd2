// ObjectPlan: an object as schedules and generators know it, and the one way into a TimedScene.
//
// Schedules come in any order and say things twice. What that means is settled here, once:
//
//   events of one instant       the last one listed holds; what is shown and hidden in the same instant is never seen
//   an event without effect     is dropped (shown while it is there already)
//   never shown                 one step at 0 that hides it
//   key frames out of order     are sorted; of one instant, the last one listed holds
//   before 0, after T, 10^9 s   kept; data/scene_time.h clamps
//   rotations                   made unit length
//   no triangles                an object like any other; duplicate faces and faces without area stay: they are the
//                               source's
//   NaN, infinities, no key     an error that names the object
#pragma once

#include <string>
#include <vector>

#include "data/timed_scene.h"
#include "lod/base/result.h"

namespace data {

struct ObjectPlan {
    uint32_t mesh = 0;
    std::string id;
    std::vector<VisibilityStep> events;  ///< any order; none: there for ever. Before the first: its opposite
    std::vector<KeyFrame> keys;          ///< any order; at least one
};

/// Appends an object to a scene and returns its index. CHECKs that its mesh exists.
/// Fails as the table above says; the scene is unchanged then.
lod::Result<uint32_t> append_object(const ObjectPlan& plan, TimedScene& scene);

/// Whether a scene keeps what data/timed_scene.h promises, for scenes that did not come through append_object: times
/// strictly rising and finite, ranges and indices inside their arrays, unit rotations and normals, unique ids, T > 0.
/// Fails naming the first object or mesh that does not.
lod::Result<lod::Ok> check_timed_scene(const TimedScene& scene);

}  // namespace data
