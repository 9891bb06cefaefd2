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

bool is_ever_there(const StepFunction& f) {
    return f.value.size() > 1 || f.value[0] > 0.0;
}

}  // namespace

void stays_of(const data::TimedScene& scene, const data::TimedObject& object, double least_rest_s,
              std::vector<Stay>& out) {
    out.clear();
    const data::MotionClass motion_class = data::motion_class(scene, object);
    StepFunction left = visibility_of(scene, object);
    if (motion_class != data::MotionClass::kDynamic) {
        out.push_back({left, {object.keys.begin, object.keys.begin + 1}, motion_class});
        return;
    }
    for (const Rest& rest : rests_of(scene, object, least_rest_s)) {
        const StepFunction inside = function_of({&rest.span, 1}, scene.end_s, rest.span.end_s == scene.end_s);
        StepFunction seen = product(left, inside);
        if (!is_ever_there(seen)) continue;
        out.push_back({std::move(seen), {rest.key, rest.key + 1}, data::MotionClass::kPseudoDynamic});
        left = product(left, complement(inside));
    }
    if (out.empty() || is_ever_there(left)) out.push_back({left, object.keys, motion_class});
}

}  // namespace objects
