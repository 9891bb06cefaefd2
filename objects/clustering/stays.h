// Stays: an object that moves now and then is many objects that do not, and one that does in between.
//
//     key frames   o-----o      o--------------o     o------>
//     pose         rest   moves      rest        moves  rest
//     leaves       stay 0 | mover |   stay 1    | mover | stay 2
//
// What rests can be clustered with its neighbours like anything that only comes and goes; a scene whose people and
// vehicles mostly stand where they are needs few commands at any time.
#pragma once

#include <vector>

#include "objects/clustering/step_function.h"

namespace objects {

/// A part of an object's time, as a leaf of its own.
struct Stay {
    StepFunction visibility;
    data::IndexRange keys;  ///< one: it stands there; several: it moves
    data::MotionClass motion_class = data::MotionClass::kStatic;
};

/// The stays of an object. Their visibilities add up to the object's at every time; `out` is cleared first, never empty
/// afterwards. One that never moves has one; one that does has a stay for each rest of at least `least_rest_s`, and one
/// for all the time in between if it is seen then.
void stays_of(const data::TimedScene& scene, const data::TimedObject& object, double least_rest_s,
              std::vector<Stay>& out);

}  // namespace objects
