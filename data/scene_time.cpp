#include "data/scene_time.h"

#include <algorithm>

namespace data {

namespace {

/// The first element whose time is after `time_s`.
template <typename Timed>
size_t first_after(std::span<const Timed> row, double time_s) {
    const auto later = [](double time, const Timed& element) { return time < element.time_s; };
    return static_cast<size_t>(std::upper_bound(row.begin(), row.end(), time_s, later) - row.begin());
}

}  // namespace

double clamped_time(const TimedScene& scene, double time_s) {
    return time_s > 0.0 ? std::min(time_s, scene.end_s) : 0.0;  // NaN is not above 0
}

std::span<const VisibilityStep> steps_of(const TimedScene& scene, const TimedObject& object) {
    return std::span(scene.steps).subspan(object.steps.begin, object.steps.size());
}

std::span<const KeyFrame> keys_of(const TimedScene& scene, const TimedObject& object) {
    return std::span(scene.keys).subspan(object.keys.begin, object.keys.size());
}

bool is_visible(const TimedScene& scene, const TimedObject& object, double time_s) {
    const auto steps = steps_of(scene, object);
    if (steps.empty()) return true;
    const size_t next = first_after(steps, clamped_time(scene, time_s));
    return next == 0 ? !steps[0].is_visible : steps[next - 1].is_visible;
}

void visible_spans(const TimedScene& scene, const TimedObject& object, std::vector<TimeSpan>& out) {
    out.clear();
    bool was_there = false;
    const auto set = [&](double time_s, bool is_there) {
        if (is_there && !was_there) out.push_back({time_s, scene.end_s});
        if (!is_there && was_there) out.back().end_s = time_s;
        was_there = is_there;
    };
    set(0.0, is_visible(scene, object, 0.0));
    for (const VisibilityStep& step : steps_of(scene, object)) {
        if (step.time_s > 0.0 && step.time_s <= scene.end_s) set(step.time_s, step.is_visible);
    }
}

double visible_s(const TimedScene& scene, const TimedObject& object) {
    double total_s = 0.0, begin_s = 0.0;
    bool is_there = is_visible(scene, object, 0.0);
    for (const VisibilityStep& step : steps_of(scene, object)) {
        const double time_s = clamped_time(scene, step.time_s);
        if (is_there) total_s += time_s - begin_s;
        begin_s = time_s;
        is_there = step.time_s <= 0.0 ? is_there : step.is_visible;
    }
    return is_there ? total_s + (scene.end_s - begin_s) : total_s;
}

ObjectPose pose_at(const TimedScene& scene, const TimedObject& object, double time_s) {
    return pose_between(keys_of(scene, object), clamped_time(scene, time_s));
}

ObjectPose pose_between(std::span<const KeyFrame> keys, double time_s) {
    const size_t next = first_after(keys, time_s);
    if (next == 0) return {keys.front().position, keys.front().rotation};
    const KeyFrame& from = keys[next - 1];
    if (next == keys.size()) return {from.position, from.rotation};
    const KeyFrame& to = keys[next];
    const double share = (time_s - from.time_s) / (to.time_s - from.time_s);
    return {glm::mix(from.position, to.position, share), glm::slerp(from.rotation, to.rotation, share)};
}

MotionClass motion_class(const TimedScene& scene, const TimedObject& object) {
    const auto keys = keys_of(scene, object);
    for (const KeyFrame& key : keys) {
        if (key.position != keys[0].position || key.rotation != keys[0].rotation)
            return MotionClass::kDynamic;
    }
    if (!is_visible(scene, object, 0.0)) return MotionClass::kPseudoDynamic;
    for (const VisibilityStep& step : steps_of(scene, object)) {
        if (step.time_s > 0.0 && step.time_s <= scene.end_s && !step.is_visible)
            return MotionClass::kPseudoDynamic;
    }
    return MotionClass::kStatic;
}

ClassCounts count_classes(const TimedScene& scene) {
    ClassCounts counts;
    for (const TimedObject& object : scene.objects) {
        const auto index = static_cast<size_t>(motion_class(scene, object));
        ++counts.objects[index];
        counts.triangles[index] += scene.meshes[object.mesh].triangles.size();
    }
    return counts;
}

}  // namespace data
