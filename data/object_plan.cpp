#include "data/object_plan.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

namespace data {

namespace {

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
bool is_finite(const KeyFrame& key) {
    const glm::dquat& q = key.rotation;
    return std::isfinite(key.time_s) && is_finite(key.position) && std::isfinite(q.x) && std::isfinite(q.y) &&
           std::isfinite(q.z) && std::isfinite(q.w);
}

lod::Error bad(const ObjectPlan& plan, const std::string& what) {
    return lod::Error{"object '" + plan.id + "': " + what};
}

constexpr auto kEarlier = [](const auto& a, const auto& b) { return a.time_s < b.time_s; };

/// The events that change something, in order, one an instant.
std::vector<VisibilityStep> steps_from(std::vector<VisibilityStep> events) {
    std::stable_sort(events.begin(), events.end(), kEarlier);
    std::vector<VisibilityStep> steps;
    if (events.empty()) return steps;
    const bool was_there = !events[0].is_visible;
    bool is_there = was_there;
    for (size_t i = 0; i < events.size(); ++i) {
        const bool is_last_of_instant = i + 1 == events.size() || events[i + 1].time_s != events[i].time_s;
        if (!is_last_of_instant || events[i].is_visible == is_there) continue;
        is_there = events[i].is_visible;
        steps.push_back(events[i]);
    }
    if (steps.empty() && !was_there) steps.push_back({0.0, false});
    return steps;
}

std::vector<KeyFrame> keys_from(std::vector<KeyFrame> keys) {
    std::stable_sort(keys.begin(), keys.end(), kEarlier);
    std::vector<KeyFrame> kept;
    for (const KeyFrame& key : keys) {
        if (!kept.empty() && kept.back().time_s == key.time_s) kept.pop_back();
        kept.push_back(key);
        kept.back().rotation = glm::normalize(key.rotation);
    }
    return kept;
}

template <typename T>
IndexRange append(const std::vector<T>& row, std::vector<T>& to) {
    const auto begin = static_cast<uint32_t>(to.size());
    to.insert(to.end(), row.begin(), row.end());
    return {begin, static_cast<uint32_t>(to.size())};
}

}  // namespace

lod::Result<uint32_t> append_object(const ObjectPlan& plan, TimedScene& scene) {
    CHECK(plan.mesh < scene.meshes.size());
    if (plan.keys.empty()) return bad(plan, "has no key frame, expected at least one");
    for (const VisibilityStep& event : plan.events) {
        if (!std::isfinite(event.time_s)) return bad(plan, "an event's time is no number, expected seconds");
    }
    for (const KeyFrame& key : plan.keys) {
        if (!is_finite(key))
            return bad(plan, "a key frame holds no number, expected a time, position and rotation");
        if (!(glm::length(key.rotation) > 1e-9))
            return bad(plan, "a key frame's rotation is 0, expected a quaternion");
    }
    TimedObject object;
    object.mesh = plan.mesh;
    object.id = plan.id;
    object.steps = append(steps_from(plan.events), scene.steps);
    object.keys = append(keys_from(plan.keys), scene.keys);
    scene.objects.push_back(std::move(object));
    return static_cast<uint32_t>(scene.objects.size() - 1);
}

namespace {

/// What is wrong with a mesh; nullptr: nothing.
const char* fault_of(const TimedMesh& mesh) {
    const size_t count = mesh.positions.size();
    if (mesh.normals.size() != count || mesh.colours.size() != count)
        return "has not one normal and colour per vertex";
    for (const glm::vec3& position : mesh.positions) {
        if (!is_finite(glm::dvec3(position))) return "has a position that is no number";
    }
    for (const glm::vec3& normal : mesh.normals) {
        if (!(std::abs(glm::length(normal) - 1.0f) < 1e-3f)) return "has a normal that is not of unit length";
    }
    for (const auto& triangle : mesh.triangles) {
        for (uint32_t corner : triangle) {
            if (corner >= count) return "has a triangle with a corner that does not exist";
        }
    }
    return nullptr;
}

bool is_inside(const IndexRange& range, size_t size) {
    return range.begin <= range.end && range.end <= size;
}

template <typename Row>
bool is_rising(const Row& row) {
    for (size_t i = 0; i < row.size(); ++i) {
        if (!std::isfinite(row[i].time_s) || (i > 0 && !(row[i - 1].time_s < row[i].time_s))) return false;
    }
    return true;
}

const char* fault_of(const TimedScene& scene, const TimedObject& object) {
    if (object.mesh >= scene.meshes.size()) return "has a mesh that does not exist";
    if (!is_inside(object.steps, scene.steps.size()) || !is_inside(object.keys, scene.keys.size()))
        return "has steps or key frames outside the scene's";
    if (object.keys.size() == 0) return "has no key frame";
    const std::span keys = std::span(scene.keys).subspan(object.keys.begin, object.keys.size());
    if (!is_rising(std::span(scene.steps).subspan(object.steps.begin, object.steps.size())))
        return "has events whose times do not rise";
    if (!is_rising(keys)) return "has key frames whose times do not rise";
    for (const KeyFrame& key : keys) {
        if (!is_finite(key) || !(std::abs(glm::length(key.rotation) - 1.0) < 1e-6))
            return "has a key frame that is no position and unit rotation";
    }
    return nullptr;
}

}  // namespace

lod::Result<lod::Ok> check_timed_scene(const TimedScene& scene) {
    if (!(scene.end_s > 0.0) || !std::isfinite(scene.end_s))
        return lod::Error{"scene: its end is not a time after 0 s, expected a positive number"};
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        if (const char* fault = fault_of(scene.meshes[i]))
            return lod::Error{"mesh " + std::to_string(i) + " " + fault};
    }
    std::vector<std::string_view> ids;
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const TimedObject& object = scene.objects[i];
        if (const char* fault = fault_of(scene, object))
            return lod::Error{"object " + std::to_string(i) + " '" + object.id + "' " + fault};
        if (!object.id.empty()) ids.push_back(object.id);
    }
    std::sort(ids.begin(), ids.end());
    const auto twin = std::adjacent_find(ids.begin(), ids.end());
    if (twin != ids.end())
        return lod::Error{"object '" + std::string(*twin) + "' exists twice, expected unique ids"};
    return lod::Ok{};
}

}  // namespace data
