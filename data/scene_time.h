// What a TimedScene says of one object at one time: is it there, where is it, does it ever change.
//
// Every time is clamped to [0, T] first; NaN counts as 0.
#pragma once

#include <span>
#include <vector>

#include "data/timed_scene.h"

namespace data {

/// `time_s` clamped to [0, end_s].
double clamped_time(const TimedScene& scene, double time_s);

std::span<const VisibilityStep> steps_of(const TimedScene& scene, const TimedObject& object);
std::span<const KeyFrame> keys_of(const TimedScene& scene, const TimedObject& object);

/// v(t). Cost: O(log steps).
bool is_visible(const TimedScene& scene, const TimedObject& object, double time_s);

/// A time during which an object is there: from begin_s, included, to end_s, excluded but for T itself.
struct TimeSpan {
    double begin_s = 0.0, end_s = 0.0;
};

/// The spans of [0, T] in which an object is there, in order, none touching another; `out` is cleared first. One that
/// appears at T itself is a span of no length.
void visible_spans(const TimedScene& scene, const TimedObject& object, std::vector<TimeSpan>& out);

/// The integral of v over [0, T], s: exact but for the rounding of each difference and of their sum.
double visible_s(const TimedScene& scene, const TimedObject& object);

/// Where an object is.
struct ObjectPose {
    glm::dvec3 position{0.0};                 ///< scene frame, metres
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< scene from object, unit length
};

/// p(t): positions linear, rotations along the shorter arc at an even rate; at rest outside the key frames.
/// Cost: O(log keys); an arc costs trigonometry.
ObjectPose pose_at(const TimedScene& scene, const TimedObject& object, double time_s);

/// The same of key frames alone; not empty, times strictly rising; `time_s` as it is.
ObjectPose pose_between(std::span<const KeyFrame> keys, double time_s);

/// Dynamic: some two of its key frames differ. Else static when it is there at every time of [0, T], else
/// pseudo-dynamic. What happens outside [0, T] makes no difference to visibility.
/// Source: Semenov, Shutkin, Zolotov et al., Visualization of large scenes with deterministic dynamics (2020),
/// section 2. Differs from it in: a moving object that is always there is dynamic, one that never is pseudo-dynamic.
MotionClass motion_class(const TimedScene& scene, const TimedObject& object);

/// Objects and their triangles by class, indexed by MotionClass.
struct ClassCounts {
    std::array<uint64_t, 3> objects{}, triangles{};
};
ClassCounts count_classes(const TimedScene& scene);

}  // namespace data
