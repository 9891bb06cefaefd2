// Stays: an object that moves now and then is many objects that do not, and one that does in between.
//
//     key frames   o-----o      o--------------o     o------>
//     pose         rest   moves      rest        moves  rest
//     leaves       stay 0 | mover |   stay 1    | mover | stay 2
//
// What rests can be clustered with its neighbours like anything that only comes and goes; a scene whose people and
// vehicles mostly stand where they are needs few commands at any time.
//
// Objects with the same key times are companions: parts of a vehicle. As long as none of them turns they stand in one
// another's frame where they stood, so the time in which they move is two leaves: one that glides, one while some turn.
#pragma once

#include <map>
#include <vector>

#include "objects/clustering/step_function.h"

namespace objects {

/// A part of an object's time, as a leaf of its own.
struct Stay {
    StepFunction visibility;
    data::IndexRange keys;  ///< one: it stands there; several: it moves
    data::MotionClass motion_class = data::MotionClass::kStatic;
    bool is_turning = false;  ///< moves, while it or a companion turns; another stay is for when all glide
};

/// Who moves with whom, and when any of them turns.
class Companions {
  public:
    explicit Companions(const data::TimedScene& scene);

    /// Whether some companion's rotation differs between a key frame and the next: [keys of the object - 1]; empty: it has
    /// none.
    const std::vector<bool>& turns(const data::TimedScene& scene, const data::TimedObject& object) const;

  private:
    struct Group {
        uint32_t objects = 0;
        std::vector<bool> turns;
    };
    std::map<std::vector<double>, Group> groups_;  ///< by key times
    std::vector<bool> none_;
};

/// The stays of an object. Their visibilities add up to the object's at every time; `out` is cleared first, never empty
/// afterwards. One that never moves has one; one that does has a stay for each rest of at least `least_rest_s`, and one
/// or two for all the time in between if it is seen then.
/// @param turns  Companions::turns
void stays_of(const data::TimedScene& scene, const data::TimedObject& object, const std::vector<bool>& turns,
              double least_rest_s, std::vector<Stay>& out);

}  // namespace objects
