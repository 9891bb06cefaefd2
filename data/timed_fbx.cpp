#include "data/timed_fbx.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "data/fbx_node.h"
#include "data/fbx_time.h"
#include "data/scene_time.h"

namespace data {

namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr int32_t kStep = 0x2, kLinear = 0x4;  // interpolation of a curve's keys

/// Ids of a file's objects; 0 is the scene's root.
enum class Kind : int64_t { kMaterial = 1, kGeometry, kModel, kNode, kCurve, kStack, kLayer };
int64_t id_of(Kind kind, size_t number, int part = 0) {
    return (static_cast<int64_t>(kind) << 48) + (static_cast<int64_t>(number) << 4) + part;
}

std::string full_name(const std::string& name, const char* kind) {
    return name + std::string("\0\x01", 2) + kind;
}

FbxNode record(const char* name, std::vector<FbxProperty> properties, std::vector<FbxNode> children = {}) {
    return {name, std::move(properties), std::move(children)};
}

/// A line of Properties70: name, type, label, flags, values.
FbxNode property(const char* name, const char* type, const char* label, const char* flags,
                 std::vector<FbxProperty> values) {
    std::vector<FbxProperty> all = {std::string(name), std::string(type), std::string(label),
                                    std::string(flags)};
    all.insert(all.end(), values.begin(), values.end());
    return record("P", std::move(all));
}

FbxNode whole(const char* name, int32_t value) {
    return property(name, "int", "Integer", "", {value});
}

FbxNode global_settings(int64_t end_ticks) {
    return record("GlobalSettings", {},
                  {record("Version", {int32_t{1000}}),
                   record("Properties70", {},
                          {whole("UpAxis", 2), whole("UpAxisSign", 1), whole("FrontAxis", 1),
                           whole("FrontAxisSign", -1), whole("CoordAxis", 0), whole("CoordAxisSign", 1),
                           property("UnitScaleFactor", "double", "Number", "", {100.0}),
                           property("TimeSpanStart", "KTime", "Time", "", {int64_t{0}}),
                           property("TimeSpanStop", "KTime", "Time", "", {end_ticks})})});
}

/// What each vertex has in a layer: `values` as FBX's array of doubles.
FbxNode vertex_layer(const char* layer, const char* array, std::vector<double> values) {
    return record(
        layer, {int32_t{0}},
        {record("Version", {int32_t{101}}), record("Name", {std::string()}),
         record("MappingInformationType", {std::string("ByVertice")}),
         record("ReferenceInformationType", {std::string("Direct")}), record(array, {std::move(values)})});
}

FbxNode geometry(const TimedMesh& mesh, size_t number) {
    std::vector<double> positions, normals, colours;
    std::vector<int32_t> corners;
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            positions.push_back(static_cast<double>(mesh.positions[i][axis]));
            normals.push_back(static_cast<double>(mesh.normals[i][axis]));
        }
        for (int channel = 0; channel < 4; ++channel)
            colours.push_back(mesh.colours[i][channel] / 255.0);
    }
    for (const auto& [a, b, c] : mesh.triangles) {  // the last corner of a polygon is written inverted
        for (const uint32_t corner : {a, b, ~c})
            corners.push_back(static_cast<int32_t>(corner));
    }
    const auto use = [](const char* type) {
        return record("LayerElement", {},
                      {record("Type", {std::string(type)}), record("TypedIndex", {int32_t{0}})});
    };
    return record("Geometry",
                  {id_of(Kind::kGeometry, number),
                   full_name("mesh-" + std::to_string(number + 1), "Geometry"), std::string("Mesh")},
                  {record("GeometryVersion", {int32_t{124}}), record("Vertices", {std::move(positions)}),
                   record("PolygonVertexIndex", {std::move(corners)}),
                   vertex_layer("LayerElementNormal", "Normals", std::move(normals)),
                   vertex_layer("LayerElementColor", "Colors", std::move(colours)),
                   record("LayerElementMaterial", {int32_t{0}},
                          {record("Version", {int32_t{101}}), record("Name", {std::string()}),
                           record("MappingInformationType", {std::string("AllSame")}),
                           record("ReferenceInformationType", {std::string("IndexToDirect")}),
                           record("Materials", {std::vector<int32_t>{0}})}),
                   record("Layer", {int32_t{0}},
                          {record("Version", {int32_t{100}}), use("LayerElementNormal"),
                           use("LayerElementColor"), use("LayerElementMaterial")})});
}

/// Angles in degrees about x, then y, then z.
glm::dvec3 euler_deg(const glm::dquat& rotation) {
    const glm::dmat3 m = glm::mat3_cast(rotation);  // m[column][row]
    const double sin_y = std::min(1.0, std::max(-1.0, -m[0][2]));
    if (std::abs(sin_y) > 1.0 - 1e-12)
        return kDegPerRad * glm::dvec3(0.0, std::asin(sin_y), std::atan2(-m[1][0], m[1][1]));
    return kDegPerRad *
           glm::dvec3(std::atan2(m[1][2], m[2][2]), std::asin(sin_y), std::atan2(m[0][1], m[0][0]));
}

FbxNode model(const TimedObject& object, const KeyFrame& pose, size_t number, bool is_there) {
    const glm::dvec3 &p = pose.position, angles = euler_deg(pose.rotation);
    return record("Model", {id_of(Kind::kModel, number), full_name(object.id, "Model"), std::string("Mesh")},
                  {record("Version", {int32_t{232}}),
                   record("Properties70", {},
                          {property("Lcl Translation", "Lcl Translation", "", "A", {p.x, p.y, p.z}),
                           property("Lcl Rotation", "Lcl Rotation", "", "A", {angles.x, angles.y, angles.z}),
                           property("Visibility", "Visibility", "", "A", {is_there ? 1.0 : 0.0})}),
                   record("Culling", {std::string("CullingOff")})});
}

/// One curve's keys.
struct Keys {
    std::vector<int64_t> ticks;
    std::vector<float> values;
};

FbxNode curve(int64_t id, Keys keys, int32_t interpolation) {
    const auto count = static_cast<int32_t>(keys.ticks.size());
    return record(
        "AnimationCurve", {id, full_name("", "AnimCurve"), std::string()},
        {record("Default", {0.0}), record("KeyVer", {int32_t{4008}}),
         record("KeyTime", {std::move(keys.ticks)}), record("KeyValueFloat", {std::move(keys.values)}),
         record("KeyAttrFlags", {std::vector<int32_t>{interpolation}}),
         record("KeyAttrDataFloat", {std::vector<float>{0.0f, 0.0f, 0.0f, 0.0f}}),
         record("KeyAttrRefCount", {std::vector<int32_t>{count}})});
}

/// Writes objects, and remembers how they hang together.
class Writer {
  public:
    explicit Writer(std::string& out) : out_(out) {}

    void add(const FbxNode& node) { append_fbx_node(node, out_); }
    void connect(int64_t child, int64_t parent) {
        connections_.push_back(record("C", {std::string("OO"), child, parent}));
    }
    void connect(int64_t child, int64_t parent, const char* property) {
        connections_.push_back(record("C", {std::string("OP"), child, parent, std::string(property)}));
    }

    /// A property of a model driven by curves, one a channel ("d|X", ..).
    void animate(size_t number, int part, const char* property_name,
                 std::vector<std::pair<const char*, Keys>> channels, int32_t interpolation) {
        const int64_t node = id_of(Kind::kNode, number, part);
        const char* short_name = part == 0 ? "Visibility" : part == 1 ? "T" : "R";
        std::vector<FbxNode> defaults;
        for (const auto& [channel, keys] : channels)
            defaults.push_back(property(channel, "Number", "", "A", {static_cast<double>(keys.values[0])}));
        add(record("AnimationCurveNode", {node, full_name(short_name, "AnimCurveNode"), std::string()},
                   {record("Properties70", {}, std::move(defaults))}));
        connect(node, id_of(Kind::kLayer, 0));
        connect(node, id_of(Kind::kModel, number), property_name);
        for (size_t i = 0; i < channels.size(); ++i) {
            const int64_t id = id_of(Kind::kCurve, number, 4 * part + static_cast<int>(i));
            add(curve(id, std::move(channels[i].second), interpolation));
            connect(id, node, channels[i].first);
        }
    }

    const std::vector<FbxNode>& connections() const { return connections_; }

  private:
    std::string& out_;
    std::vector<FbxNode> connections_;
};

void animate_visibility(const TimedScene& scene, const TimedObject& object, size_t number, Writer& writer) {
    const auto steps = steps_of(scene, object);
    if (steps.empty()) return;
    Keys keys;
    const auto add = [&](double time_s, bool is_visible) {
        keys.ticks.push_back(fbx_ticks(time_s));
        keys.values.push_back(is_visible ? 1.0f : 0.0f);
    };
    add(std::min(0.0, steps[0].time_s) - 1.0, !steps[0].is_visible);  // what was before the first step
    for (const VisibilityStep& step : steps)
        add(step.time_s, step.is_visible);
    writer.animate(number, 0, "Visibility", {{"d|Visibility", std::move(keys)}}, kStep);
}

void animate_pose(std::span<const KeyFrame> frames, size_t number, Writer& writer) {
    if (frames.size() < 2) return;
    std::array<Keys, 6> keys;
    std::optional<glm::dvec3> before_deg;
    for (const KeyFrame& frame : frames) {
        glm::dvec3 angles = euler_deg(frame.rotation);
        for (int axis = 0; axis < 3 && before_deg; ++axis)  // the short way round
            angles[axis] += 360.0 * std::round(((*before_deg)[axis] - angles[axis]) / 360.0);
        before_deg = angles;
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<size_t>(axis);
            keys[i].values.push_back(static_cast<float>(frame.position[axis]));
            keys[i + 3].values.push_back(static_cast<float>(angles[axis]));
        }
        for (Keys& channel : keys)
            channel.ticks.push_back(fbx_ticks(frame.time_s));
    }
    const char* names[] = {"d|X", "d|Y", "d|Z"};
    std::vector<std::pair<const char*, Keys>> places, turns;
    for (size_t axis = 0; axis < 3; ++axis) {
        places.emplace_back(names[axis], std::move(keys[axis]));
        turns.emplace_back(names[axis], std::move(keys[axis + 3]));
    }
    writer.animate(number, 1, "Lcl Translation", std::move(places), kLinear);
    writer.animate(number, 2, "Lcl Rotation", std::move(turns), kLinear);
}

void add_objects(const TimedScene& scene, Writer& writer) {
    writer.add(
        record("Material", {id_of(Kind::kMaterial, 0), full_name("paint", "Material"), std::string()},
               {record("Version", {int32_t{102}}), record("ShadingModel", {std::string("lambert")}),
                record("Properties70", {}, {property("DiffuseColor", "Color", "", "A", {1.0, 1.0, 1.0})})}));
    writer.add(record("AnimationStack",
                      {id_of(Kind::kStack, 0), full_name("schedule", "AnimStack"), std::string()},
                      {record("Properties70", {},
                              {property("LocalStop", "KTime", "Time", "", {fbx_ticks(scene.end_s)})})}));
    writer.add(record("AnimationLayer",
                      {id_of(Kind::kLayer, 0), full_name("schedule", "AnimLayer"), std::string()},
                      {record("Properties70", {})}));
    writer.connect(id_of(Kind::kLayer, 0), id_of(Kind::kStack, 0));
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        if (!scene.meshes[i].triangles.empty()) writer.add(geometry(scene.meshes[i], i));
    }
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const TimedObject& object = scene.objects[i];
        const auto frames = keys_of(scene, object);
        writer.add(model(object, frames[0], i, is_visible(scene, object, 0.0)));
        writer.connect(id_of(Kind::kModel, i), 0);
        if (!scene.meshes[object.mesh].triangles.empty()) {
            writer.connect(id_of(Kind::kGeometry, object.mesh), id_of(Kind::kModel, i));
            writer.connect(id_of(Kind::kMaterial, 0), id_of(Kind::kModel, i));
        }
        animate_visibility(scene, object, i, writer);
        animate_pose(frames, i, writer);
    }
}

}  // namespace

lod::Result<std::string> timed_fbx_bytes(const TimedScene& scene) {
    const auto is_too_late = [](const auto& timed) { return std::abs(timed.time_s) > kFbxEndS; };
    if (scene.end_s > kFbxEndS || std::any_of(scene.steps.begin(), scene.steps.end(), is_too_late) ||
        std::any_of(scene.keys.begin(), scene.keys.end(), is_too_late))
        return lod::Error{
            "FBX holds no times beyond 199 million seconds, expected a shorter schedule or GLB with CSV"};
    std::string out;
    begin_fbx_file(out);
    append_fbx_node(
        record("FBXHeaderExtension", {},
               {record("FBXHeaderVersion", {int32_t{1003}}), record("FBXVersion", {int32_t{7400}}),
                record("Creator", {std::string("Harrier")})}),
        out);
    append_fbx_node(global_settings(fbx_ticks(scene.end_s)), out);
    Writer writer(out);
    const size_t objects = begin_fbx_node("Objects", out);
    add_objects(scene, writer);
    end_fbx_node(objects, out);
    const size_t connections = begin_fbx_node("Connections", out);
    for (const FbxNode& connection : writer.connections())
        append_fbx_node(connection, out);
    end_fbx_node(connections, out);
    end_fbx_file(out);
    if (out.size() > UINT32_MAX)
        return lod::Error{"FBX of this scene is larger than 4 GiB, expected GLB with CSV instead"};
    return out;
}

}  // namespace data
