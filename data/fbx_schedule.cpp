#include "data/fbx_schedule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string_view>

#include "data/fbx_node.h"
#include "data/fbx_time.h"
#include "data/file_bytes.h"

namespace data {

namespace {

constexpr size_t kMaxBytes = size_t{4} << 30;
constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr int kMaxDepth = 64;

/// A curve: values at ticks, rising.
struct Curve {
    std::vector<int64_t> ticks;
    std::vector<double> values;
};

/// What is known of a model. Channels of translation and rotation: x, y, z.
struct Model {
    std::string name;
    int64_t parent = 0;
    glm::dvec3 position{0.0}, angles_deg{0.0};
    bool is_visible = true;
    const Curve* visibility = nullptr;
    std::array<const Curve*, 3> position_curves{}, angle_curves{};

    bool moves() const {
        const auto is_there = [](const Curve* curve) { return curve != nullptr; };
        return std::any_of(position_curves.begin(), position_curves.end(), is_there) ||
               std::any_of(angle_curves.begin(), angle_curves.end(), is_there);
    }
};

struct FbxScene {
    std::map<int64_t, Model> models;
    std::map<int64_t, Curve> curves;
    double end_s = 0.0;
};

/// A named line of Properties70, or null.
const FbxNode* find_property(const FbxNode& node, std::string_view name) {
    const FbxNode* properties = find_child(node, "Properties70");
    if (properties == nullptr) return nullptr;
    for (const FbxNode& line : properties->children) {
        const std::string* text = text_at(line, 0);
        if (text != nullptr && *text == name) return &line;
    }
    return nullptr;
}

void read_triple(const FbxNode& model, const char* name, glm::dvec3& out) {
    const FbxNode* line = find_property(model, name);
    for (int axis = 0; axis < 3 && line != nullptr; ++axis)
        out[axis] = number_at(*line, 4 + static_cast<size_t>(axis), out[axis]);
}

Model read_model(const FbxNode& node) {
    Model model;
    if (const std::string* name = text_at(node, 1)) model.name = plain_name(*name);
    read_triple(node, "Lcl Translation", model.position);
    read_triple(node, "Lcl Rotation", model.angles_deg);
    if (const FbxNode* line = find_property(node, "Visibility"))
        model.is_visible = number_at(*line, 4, 1.0) >= 0.5;
    return model;
}

Curve read_curve(const FbxNode& node) {
    Curve curve;
    const FbxNode *times = find_child(node, "KeyTime"), *values = find_child(node, "KeyValueFloat");
    if (times == nullptr || values == nullptr || times->properties.empty() || values->properties.empty())
        return curve;
    const auto* ticks = std::get_if<std::vector<int64_t>>(&times->properties[0]);
    const auto* floats = std::get_if<std::vector<float>>(&values->properties[0]);
    if (ticks == nullptr || floats == nullptr || ticks->size() != floats->size()) return curve;
    for (size_t i = 0; i < ticks->size(); ++i) {
        const auto value = static_cast<double>((*floats)[i]);
        if (!std::isfinite(value) || (i > 0 && (*ticks)[i] <= curve.ticks.back())) continue;
        curve.ticks.push_back((*ticks)[i]);
        curve.values.push_back(value);
    }
    return curve;
}

/// Ties curves to their models: curve -> node by a channel, node -> model by a property.
void connect(const FbxNode& connections, FbxScene& scene) {
    struct Target {
        int64_t model;
        std::string property;
    };
    std::map<int64_t, Target> nodes;
    for (const FbxNode& line : connections.children) {
        const auto child = integer_at(line, 1), parent = integer_at(line, 2);
        if (!child || !parent) continue;
        const std::string* property = text_at(line, 3);
        if (property != nullptr && scene.models.contains(*parent)) nodes[*child] = {*parent, *property};
        if (property == nullptr && scene.models.contains(*child) && scene.models.contains(*parent))
            scene.models[*child].parent = *parent;
    }
    for (const FbxNode& line : connections.children) {
        const auto child = integer_at(line, 1), parent = integer_at(line, 2);
        const std::string* channel = text_at(line, 3);
        if (!child || !parent || channel == nullptr) continue;
        const auto curve = scene.curves.find(*child);
        const auto node = nodes.find(*parent);
        if (curve == scene.curves.end() || node == nodes.end() || curve->second.ticks.empty()) continue;
        Model& model = scene.models[node->second.model];
        const std::string& property = node->second.property;
        if (property == "Visibility") model.visibility = &curve->second;
        const size_t axis = *channel == "d|X" ? 0 : *channel == "d|Y" ? 1 : *channel == "d|Z" ? 2 : 3;
        if (axis < 3 && property == "Lcl Translation") model.position_curves[axis] = &curve->second;
        if (axis < 3 && property == "Lcl Rotation") model.angle_curves[axis] = &curve->second;
    }
}

FbxScene read_scene(const std::vector<FbxNode>& top) {
    FbxScene scene;
    for (const FbxNode& section : top) {
        if (section.name == "GlobalSettings") {
            const FbxNode* stop = find_property(section, "TimeSpanStop");
            const auto ticks = stop == nullptr ? std::nullopt : integer_at(*stop, 4);
            if (ticks && *ticks > 0) scene.end_s = fbx_seconds(*ticks);
        }
        for (const FbxNode& node : section.children) {
            const auto id = integer_at(node, 0);
            if (section.name != "Objects" || !id) continue;
            if (node.name == "Model") scene.models[*id] = read_model(node);
            if (node.name == "AnimationCurve") scene.curves[*id] = read_curve(node);
        }
    }
    for (const FbxNode& section : top) {
        if (section.name == "Connections") connect(section, scene);
    }
    return scene;
}

/// The curve's value, linear between keys; `otherwise` where there is no curve.
double linear_at(const Curve* curve, int64_t ticks, double otherwise) {
    if (curve == nullptr) return otherwise;
    const auto next = std::upper_bound(curve->ticks.begin(), curve->ticks.end(), ticks);
    const auto i = static_cast<size_t>(next - curve->ticks.begin());
    if (i == 0) return curve->values.front();
    if (i == curve->ticks.size()) return curve->values.back();
    const double share = static_cast<double>(ticks - curve->ticks[i - 1]) /
                         static_cast<double>(curve->ticks[i] - curve->ticks[i - 1]);
    return glm::mix(curve->values[i - 1], curve->values[i], share);
}

bool is_there_at(const Model& model, int64_t ticks) {
    if (model.visibility == nullptr) return model.is_visible;
    const auto next = std::upper_bound(model.visibility->ticks.begin(), model.visibility->ticks.end(), ticks);
    const auto i = static_cast<size_t>(next - model.visibility->ticks.begin());
    return model.visibility->values[i == 0 ? 0 : i - 1] >= 0.5;
}

glm::dquat rotation_of(const glm::dvec3& angles_deg) {
    const auto about = [](double angle_deg, const glm::dvec3& axis) {
        return glm::angleAxis(angle_deg * kRadPerDeg, axis);
    };
    return about(angles_deg.z, {0, 0, 1}) * about(angles_deg.y, {0, 1, 0}) * about(angles_deg.x, {1, 0, 0});
}

KeyFrame pose_at(const Model& model, int64_t ticks) {
    KeyFrame pose;
    glm::dvec3 angles_deg(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<size_t>(axis);
        pose.position[axis] = linear_at(model.position_curves[i], ticks, model.position[axis]);
        angles_deg[axis] = linear_at(model.angle_curves[i], ticks, model.angles_deg[axis]);
    }
    if (angles_deg != glm::dvec3(0.0)) pose.rotation = rotation_of(angles_deg);
    return pose;
}

/// A model and those above it, from the root down.
std::vector<const Model*> chain_of(const FbxScene& scene, const Model& model) {
    std::vector<const Model*> chain = {&model};
    while (chain.size() < kMaxDepth) {
        const auto parent = scene.models.find(chain.back()->parent);
        if (parent == scene.models.end()) break;
        chain.push_back(&parent->second);
    }
    std::reverse(chain.begin(), chain.end());
    return chain;
}

/// What changes, one event each; nothing where nothing does and the model is there.
std::vector<VisibilityStep> events_of(const std::vector<const Model*>& chain) {
    std::set<int64_t> times;
    for (const Model* model : chain) {
        if (model->visibility != nullptr)
            times.insert(model->visibility->ticks.begin(), model->visibility->ticks.end());
    }
    const auto is_there = [&](int64_t ticks) {
        return std::all_of(chain.begin(), chain.end(),
                           [&](const Model* model) { return is_there_at(*model, ticks); });
    };
    std::vector<VisibilityStep> events;
    bool was_there = is_there(INT64_MIN);
    const bool is_never_there = !was_there;
    for (const int64_t ticks : times) {
        if (is_there(ticks) == was_there) continue;
        was_there = !was_there;
        events.push_back({fbx_seconds(ticks), was_there});
    }
    if (events.empty() && is_never_there) events.push_back({0.0, false});
    return events;
}

std::vector<KeyFrame> keys_of(const std::vector<const Model*>& chain) {
    std::set<int64_t> times;
    for (const Model* model : chain) {
        for (const auto* curves : {&model->position_curves, &model->angle_curves}) {
            for (const Curve* curve : *curves) {
                if (curve != nullptr) times.insert(curve->ticks.begin(), curve->ticks.end());
            }
        }
    }
    if (times.empty()) times.insert(0);
    std::vector<KeyFrame> keys;
    for (const int64_t ticks : times) {
        KeyFrame key;
        for (const Model* model : chain) {
            const KeyFrame inner = pose_at(*model, ticks);
            key.position += key.rotation * inner.position;
            key.rotation = key.rotation * inner.rotation;
        }
        key.time_s = fbx_seconds(ticks);
        keys.push_back(key);
    }
    return keys;
}

}  // namespace

lod::Result<lod::Ok> add_fbx_schedule(const std::string& path, SourceScene& source) {
    const auto bytes = read_file(path, kMaxBytes);
    if (!bytes) return bytes.error();
    const std::string_view content(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    if (content.starts_with(";") || content.starts_with("FBXHeader")) {
        if (content.find("AnimationCurve:") == std::string_view::npos) return lod::Ok{};
        return lod::Error{path + ": text FBX with curves, expected binary FBX"};
    }
    const auto top = parse_fbx(content, path);
    if (!top) return top.error();
    const FbxScene scene = read_scene(*top);
    std::map<std::string, const Model*> by_name;
    for (const auto& [id, model] : scene.models)
        by_name.try_emplace(model.name, &model);
    source.end_s = scene.end_s;
    for (SourceObject& object : source.objects) {
        const auto found = by_name.find(object.id);
        if (found == by_name.end()) continue;
        const std::vector<const Model*> chain = chain_of(scene, *found->second);
        object.events = events_of(chain);
        const bool moves =
            std::any_of(chain.begin(), chain.end(), [](const Model* model) { return model->moves(); });
        if (moves || chain.size() == 1) object.keys = keys_of(chain);
    }
    return lod::Ok{};
}

}  // namespace data
