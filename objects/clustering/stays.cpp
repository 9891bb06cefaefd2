#include "objects/clustering/stays.h"

#include <algorithm>

namespace objects {

namespace {

StepFunction visibility_of(const data::TimedScene& scene, const data::TimedObject& object) {
    std::vector<data::TimeSpan> spans;
    data::visible_spans(scene, object, spans);
    return function_of(spans, scene.end_s, data::is_visible(scene, object, scene.end_s));
}

/// While it stands as its key frame `key` says.
struct Rest {
    uint32_t key = 0;
    data::TimeSpan span;
};

std::vector<Rest> rests_of(const data::TimedScene& scene, const data::TimedObject& object, double least_s) {
    std::vector<Rest> rests;
    const auto add = [&](uint32_t key, double begin_s, double end_s) {
        const data::TimeSpan span{std::max(begin_s, 0.0), std::min(end_s, scene.end_s)};
        if (span.end_s - span.begin_s >= least_s) rests.push_back({key, span});
    };
    double begin_s = 0.0;
    for (uint32_t key = object.keys.begin + 1; key < object.keys.end; ++key) {
        const data::KeyFrame &before = scene.keys[key - 1], &after = scene.keys[key];
        if (before.position == after.position && before.rotation == after.rotation) continue;
        add(key - 1, begin_s, before.time_s);
        begin_s = after.time_s;
    }
    add(object.keys.end - 1, begin_s, scene.end_s);
    return rests;
}

std::vector<double> key_times_of(const data::TimedScene& scene, const data::TimedObject& object) {
    std::vector<double> times_s;
    for (const data::KeyFrame& key : data::keys_of(scene, object))
        times_s.push_back(key.time_s);
    return times_s;
}

/// 1 while a companion turns.
StepFunction turning_of(const data::TimedScene& scene, const data::TimedObject& object,
                        const std::vector<bool>& turns) {
    const std::span<const data::KeyFrame> keys = data::keys_of(scene, object);
    std::vector<data::TimeSpan> spans;
    for (size_t i = 0; i < turns.size(); ++i) {
        const double begin_s = std::max(keys[i].time_s, 0.0),
                     end_s = std::min(keys[i + 1].time_s, scene.end_s);
        if (!turns[i] || begin_s >= end_s) continue;
        if (!spans.empty() && spans.back().end_s == begin_s)
            spans.back().end_s = end_s;
        else
            spans.push_back({begin_s, end_s});
    }
    return function_of(spans, scene.end_s, !spans.empty() && spans.back().end_s == scene.end_s);
}

bool is_ever_there(const StepFunction& f) {
    return f.value.size() > 1 || f.value[0] > 0.0;
}

}  // namespace

Companions::Companions(const data::TimedScene& scene) {
    for (const data::TimedObject& object : scene.objects) {
        const std::span<const data::KeyFrame> keys = data::keys_of(scene, object);
        if (keys.size() < 2) continue;
        Group& group = groups_[key_times_of(scene, object)];
        group.turns.resize(keys.size() - 1);
        ++group.objects;
        for (size_t i = 0; i + 1 < keys.size(); ++i)
            group.turns[i] = group.turns[i] || keys[i].rotation != keys[i + 1].rotation;
    }
}

const std::vector<bool>& Companions::turns(const data::TimedScene& scene,
                                           const data::TimedObject& object) const {
    const auto group = groups_.find(key_times_of(scene, object));
    return group == groups_.end() || group->second.objects < 2 ? none_ : group->second.turns;
}

void stays_of(const data::TimedScene& scene, const data::TimedObject& object, const std::vector<bool>& turns,
              double least_rest_s, std::vector<Stay>& out) {
    out.clear();
    const data::MotionClass motion_class = data::motion_class(scene, object);
    StepFunction left = visibility_of(scene, object);
    if (motion_class != data::MotionClass::kDynamic) {
        out.push_back({left, {object.keys.begin, object.keys.begin + 1}, motion_class, false});
        return;
    }
    for (const Rest& rest : rests_of(scene, object, least_rest_s)) {
        const StepFunction inside = function_of({&rest.span, 1}, scene.end_s, rest.span.end_s == scene.end_s);
        StepFunction seen = product(left, inside);
        if (!is_ever_there(seen)) continue;
        out.push_back({std::move(seen), {rest.key, rest.key + 1}, data::MotionClass::kPseudoDynamic, false});
        left = product(left, complement(inside));
    }
    if (!out.empty() && !is_ever_there(left)) return;
    const StepFunction turning = turning_of(scene, object, turns);
    const StepFunction turned = product(left, turning), glides = product(left, complement(turning));
    const bool is_split = is_ever_there(turned) && is_ever_there(glides);
    out.push_back({is_split ? glides : left, object.keys, motion_class, false});
    if (is_split) out.push_back({turned, object.keys, motion_class, true});
}

}  // namespace objects
