#include "data/timed_glb.h"

#include <algorithm>
#include <cmath>

#include "data/glb_parts.h"

namespace data {

namespace {

bool is_transparent(const TimedMesh& mesh) {
    return std::any_of(mesh.colours.begin(), mesh.colours.end(),
                       [](const glm::u8vec4& c) { return c.w < 255; });
}

int append_colours(const std::vector<glm::u8vec4>& colours, Glb& glb) {
    std::vector<glm::u16vec4> linear;
    linear.reserve(colours.size());
    const auto channel = [](uint8_t srgb) {
        return static_cast<uint16_t>(
            std::lround(65535.0 * linear_from_srgb(static_cast<float>(srgb) / 255.0f)));
    };
    for (const glm::u8vec4& c : colours)
        linear.emplace_back(channel(c.x), channel(c.y), channel(c.z), static_cast<uint16_t>(c.w * 257));
    const int view = append_view(linear.data(), linear.size() * sizeof(glm::u16vec4), kGlbVertices, glb);
    return append_accessor({view, kGlbUint16, linear.size(), ",\"type\":\"VEC4\",\"normalized\":true"}, glb);
}

std::string mesh_json(const TimedMesh& mesh, Glb& glb) {
    std::vector<uint32_t> indices;
    indices.reserve(3 * mesh.triangles.size());
    for (const auto& triangle : mesh.triangles)
        indices.insert(indices.end(), triangle.begin(), triangle.end());
    const int position = append_vectors(mesh.positions, true, glb),
              normal = append_vectors(mesh.normals, false, glb);
    const int colour = append_colours(mesh.colours, glb);
    const int index = append_indices(indices, mesh.positions.size(), glb);
    return "{\"primitives\":[{\"attributes\":{\"POSITION\":" + std::to_string(position) +
           ",\"NORMAL\":" + std::to_string(normal) + ",\"COLOR_0\":" + std::to_string(colour) +
           "},\"indices\":" + std::to_string(index) + ",\"material\":" + (is_transparent(mesh) ? "1" : "0") +
           "}]}";
}

std::string node_json(const TimedObject& object, const KeyFrame& pose, int mesh) {
    std::string json = "{\"name\":" + json_string(object.id);
    if (mesh >= 0) json += ",\"mesh\":" + std::to_string(mesh);
    const glm::dvec3& p = pose.position;
    if (p != glm::dvec3(0.0))
        json +=
            ",\"translation\":[" + json_number(p.x) + "," + json_number(p.y) + "," + json_number(p.z) + "]";
    const glm::dquat& q = pose.rotation;
    if (q != glm::dquat(1.0, 0.0, 0.0, 0.0))
        json += ",\"rotation\":[" + json_number(q.x) + "," + json_number(q.y) + "," + json_number(q.z) + "," +
                json_number(q.w) + "]";
    return json + "}";
}

/// White, so that the vertex colours show; the second lets what is behind it through.
constexpr const char* kMaterials =
    "{\"name\":\"opaque\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0.6}},"
    "{\"name\":\"clear\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0.6},"
    "\"alphaMode\":\"BLEND\"}";

}  // namespace

std::vector<char> timed_glb_bytes(const TimedScene& scene) {
    Glb glb;
    std::vector<int> mesh_index(scene.meshes.size(), -1);
    std::string meshes, nodes, children;
    int mesh_count = 0;
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        if (scene.meshes[i].triangles.empty()) continue;
        append_element(meshes, mesh_json(scene.meshes[i], glb));
        mesh_index[i] = mesh_count++;
    }
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const TimedObject& object = scene.objects[i];
        append_element(nodes, node_json(object, scene.keys[object.keys.begin], mesh_index[object.mesh]));
        append_element(children, std::to_string(i + 1));
    }
    // scene (x, y, z) -> glTF (x, z, -y)
    std::string root = "{\"name\":\"scene\",\"matrix\":[1,0,0,0,0,0,-1,0,0,1,0,0,0,0,0,1]";
    if (!children.empty()) root += ",\"children\":[" + children + "]";
    std::string json =
        "{\"asset\":{\"version\":\"2.0\",\"generator\":\"Harrier\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
        "\"nodes\":[" +
        root + "}" + (nodes.empty() ? "" : ",") + nodes + "],\"materials\":[" + kMaterials + "]";
    const auto add = [&json](const char* name, const std::string& array) {
        if (!array.empty()) json += std::string(",\"") + name + "\":[" + array + "]";
    };
    add("meshes", meshes);
    add("accessors", glb.accessors);
    add("bufferViews", glb.views);
    if (!glb.binary.empty()) add("buffers", "{\"byteLength\":" + std::to_string(glb.binary.size()) + "}");
    return pack_glb(json + "}", glb);
}

}  // namespace data
