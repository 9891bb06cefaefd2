#include "data/source_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "data/csv_cells.h"
#include "data/object_plan.h"

namespace data {

namespace {

TimedMesh mesh_of_node(const MeshNode& node) {
    return {node.positions, node.normals, node.colours, node.triangles};
}

void append_mesh(const TimedMesh& mesh, TimedMesh& to) {
    const auto first = static_cast<uint32_t>(to.positions.size());
    to.positions.insert(to.positions.end(), mesh.positions.begin(), mesh.positions.end());
    to.normals.insert(to.normals.end(), mesh.normals.begin(), mesh.normals.end());
    to.colours.insert(to.colours.end(), mesh.colours.begin(), mesh.colours.end());
    for (const auto& [a, b, c] : mesh.triangles)
        to.triangles.push_back({first + a, first + b, first + c});
}

}  // namespace

std::string UniqueIds::take(const std::string& name, size_t number) {
    std::string id(trimmed(name));
    if (id.empty()) id = "node-" + std::to_string(number);
    const std::string first = id;
    for (int copy = 2; !used_.insert(id).second; ++copy)
        id = first + "#" + std::to_string(copy);
    return id;
}

SplitTransform split_transform(const glm::dmat4& model_from_node) {
    constexpr double kRounding = 2e-6;  // of float32 in a chain of nodes
    SplitTransform split;
    split.pose.position = glm::dvec3(model_from_node[3]);
    const glm::dmat3 linear(model_from_node);
    glm::dvec3 x = linear[0], z = linear[2];
    if (!(glm::length(x) > 0.0)) x = glm::dvec3(1, 0, 0);
    x = glm::normalize(x);
    z -= glm::dot(z, x) * x;
    if (!(glm::length(z) > 1e-12))
        z = glm::cross(x, std::abs(x.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1));
    z = glm::normalize(z);
    const glm::dmat3 rotation(x, glm::cross(z, x), z);
    split.pose.rotation = glm::normalize(glm::quat_cast(rotation));
    if (rotation == glm::dmat3(1.0)) split.pose.rotation = glm::dquat(1.0, 0.0, 0.0, 0.0);
    const glm::dmat3 rest = glm::transpose(rotation) * linear;
    double off = 0.0;
    for (int col = 0; col < 3; ++col) {
        for (int row = 0; row < 3; ++row)
            off = std::max(off, std::abs(rest[col][row] - (col == row ? 1.0 : 0.0)));
    }
    if (off > kRounding) split.rest = rest;
    return split;
}

TimedMesh transformed(const TimedMesh& mesh, const glm::dmat4& matrix) {
    TimedMesh result = mesh;
    const glm::dmat3 linear(matrix);
    const double volume = glm::determinant(linear);
    const glm::dmat3 normal_matrix = volume != 0.0 ? glm::transpose(glm::inverse(linear)) : glm::dmat3(1.0);
    for (glm::vec3& position : result.positions)
        position = glm::vec3(matrix * glm::dvec4(position, 1.0));
    for (glm::vec3& normal : result.normals)
        normal = glm::vec3(glm::normalize(normal_matrix * glm::dvec3(normal)));
    if (volume < 0.0) {
        for (auto& triangle : result.triangles)
            std::swap(triangle[1], triangle[2]);
    }
    return result;
}

SourceScene objects_of_model(const SharedModel& model, const Schedule& schedule) {
    SourceScene scene;
    UniqueIds ids;
    std::map<std::pair<uint32_t, std::array<double, 9>>, uint32_t> meshes;
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        const SharedModel::Node& node = model.nodes[i];
        const bool is_bare = model.geometry[node.geometry].triangles.empty();
        if (is_bare && !(node.is_leaf && schedule.entries.contains(std::string(trimmed(node.name)))))
            continue;
        SplitTransform split = split_transform(node.model_from_node);
        std::array<double, 9> rest{};
        for (int part = 0; part < 9; ++part)
            rest[static_cast<size_t>(part)] = split.rest[part / 3][part % 3];
        const auto [place, is_new] =
            meshes.try_emplace({node.geometry, rest}, static_cast<uint32_t>(scene.meshes.size()));
        if (is_new) {
            const TimedMesh mesh = mesh_of_node(model.geometry[node.geometry]);
            scene.meshes.push_back(split.rest == glm::dmat3(1.0) ? mesh
                                                                 : transformed(mesh, glm::dmat4(split.rest)));
        }
        scene.objects.push_back({ids.take(node.name, i + 1), place->second, {}, {split.pose}});
    }
    return scene;
}

TimedMesh mesh_of_model(const SharedModel& model) {
    TimedMesh mesh;
    for (const SharedModel::Node& node : model.nodes)
        append_mesh(transformed(mesh_of_node(model.geometry[node.geometry]), node.model_from_node), mesh);
    return mesh;
}

namespace {

/// Objects that the schedule brings with it, each model read once.
lod::Result<lod::Ok> append_scheduled_models(const Schedule& schedule, const std::string& schedule_path,
                                             SourceScene& source) {
    std::set<std::string> known;
    for (const SourceObject& object : source.objects)
        known.insert(object.id);
    std::map<std::string, uint32_t> meshes;
    for (const auto& [id, entry] : schedule.entries) {
        const std::string where = schedule_path + ":" + std::to_string(entry.line) + ": ";
        if (known.contains(id) != entry.model.empty())
            return lod::Error{where +
                              (entry.model.empty()
                                   ? "'" + id + "' is no object of the scene, expected one, or a model"
                                   : "'" + id + "' is an object of the scene, expected no model for it")};
        if (entry.model.empty()) continue;
        if (entry.keys.empty())
            return lod::Error{where + "'" + id + "' has a model but no key frame, expected a place"};
        const auto [place, is_new] =
            meshes.try_emplace(entry.model, static_cast<uint32_t>(source.meshes.size()));
        if (is_new) {
            const std::filesystem::path folder = std::filesystem::path(schedule_path).parent_path();
            const auto model = read_shared_model((folder / entry.model).string());
            if (!model) return lod::Error{where + model.message()};
            source.meshes.push_back(mesh_of_model(*model));
        }
        source.objects.push_back({id, place->second, {}, entry.keys});
    }
    return lod::Ok{};
}

}  // namespace

lod::Result<TimedScene> schedule_scene(SourceScene source, const Schedule& schedule,
                                       const std::string& schedule_path) {
    if (const auto appended = append_scheduled_models(schedule, schedule_path, source); !appended)
        return appended.error();
    TimedScene scene;
    scene.origin_site = source.origin_site;
    scene.is_on_earth = source.is_on_earth;
    scene.end_s = schedule.end_s > 0.0 ? schedule.end_s
                  : source.end_s > 0.0 ? source.end_s
                                       : end_of(schedule);
    scene.meshes = std::move(source.meshes);
    scene.objects.reserve(source.objects.size());
    for (SourceObject& object : source.objects) {
        ObjectPlan plan{object.mesh, std::move(object.id), std::move(object.events), std::move(object.keys)};
        const auto entry = schedule.entries.find(plan.id);
        if (entry != schedule.entries.end()) {
            if (!entry->second.events.empty()) plan.events = entry->second.events;
            if (!entry->second.keys.empty()) plan.keys = entry->second.keys;
        }
        if (const auto appended = append_object(plan, scene); !appended)
            return lod::Error{schedule_path + ": " + appended.message()};
    }
    return scene;
}

}  // namespace data
