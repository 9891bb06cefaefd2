#include "data/glb_writer.h"

#include <cstdio>
#include <fstream>

#include "data/glb_parts.h"

namespace data {

namespace {

/// The part of a node that has one material, with the vertices it uses.
std::string primitive_json(const MeshNode& node, uint32_t material, Glb& glb) {
    std::vector<uint32_t> indices, kept(node.positions.size(), UINT32_MAX);
    std::vector<glm::vec3> positions, normals;
    for (size_t t = 0; t < node.triangles.size(); ++t) {
        if (node.triangle_material[t] != material) continue;
        for (uint32_t corner : node.triangles[t]) {
            if (kept[corner] == UINT32_MAX) {
                kept[corner] = static_cast<uint32_t>(positions.size());
                positions.push_back(node.positions[corner]);
                normals.push_back(node.normals[corner]);
            }
            indices.push_back(kept[corner]);
        }
    }
    if (indices.empty()) return {};
    const int position = append_vectors(positions, true, glb), normal = append_vectors(normals, false, glb);
    const int index = append_indices(indices, positions.size(), glb);
    return "{\"attributes\":{\"POSITION\":" + std::to_string(position) +
           ",\"NORMAL\":" + std::to_string(normal) + "},\"indices\":" + std::to_string(index) +
           ",\"material\":" + std::to_string(material) + "}";
}

std::string material_json(const MeshMaterial& material) {
    const glm::vec4& c = material.colour;
    const std::string colour = json_number(linear_from_srgb(c.x)) + "," + json_number(linear_from_srgb(c.y)) +
                               "," + json_number(linear_from_srgb(c.z));
    std::string json = "{\"name\":" + json_string(material.name) +
                       ",\"pbrMetallicRoughness\":{\"baseColorFactor\":[" + colour + "," +
                       json_number(double(c.w)) + "],\"metallicFactor\":0,\"roughnessFactor\":0.6}";
    if (c.w < 1.0f) json += ",\"alphaMode\":\"BLEND\"";
    if (material.emission > 0.0f) {
        const std::string glow = json_number(double(material.emission));
        json += ",\"emissiveFactor\":[" + glow + "," + glow + "," + glow + "]";
    }
    return json + "}";
}

std::string matrix_json(const glm::dmat4& matrix) {
    std::string json;
    for (int col = 0; col < 4; ++col) {
        for (int row = 0; row < 4; ++row)
            append_element(json, json_number(matrix[col][row]));
    }
    return "[" + json + "]";
}

std::string node_json(const PolygonMesh& mesh, size_t index, int mesh_index) {
    // mesh (x, y, z) -> glTF (x, z, -y)
    const glm::dmat4 gltf_from_mesh(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 1, 0, 0),
                                    glm::dvec4(0, 0, 0, 1));
    const MeshNode& node = mesh.nodes[index];
    const glm::dmat4 matrix =
        node.parent < 0 ? gltf_from_mesh * node.parent_from_node : node.parent_from_node;
    std::string json = "{\"name\":" + json_string(node.name);
    if (matrix != glm::dmat4(1.0)) json += ",\"matrix\":" + matrix_json(matrix);
    if (mesh_index >= 0) json += ",\"mesh\":" + std::to_string(mesh_index);
    std::string children;
    for (size_t child = index + 1; child < mesh.nodes.size(); ++child) {
        if (mesh.nodes[child].parent == static_cast<int32_t>(index))
            append_element(children, std::to_string(child));
    }
    if (!children.empty()) json += ",\"children\":[" + children + "]";
    return json + "}";
}

std::string document(const PolygonMesh& mesh, Glb& glb) {
    std::string nodes, meshes, materials, roots;
    int mesh_count = 0;
    for (size_t i = 0; i < mesh.nodes.size(); ++i) {
        std::string primitives;
        for (uint32_t material = 0; material < mesh.materials.size(); ++material) {
            const std::string primitive = primitive_json(mesh.nodes[i], material, glb);
            if (!primitive.empty()) append_element(primitives, primitive);
        }
        const bool has_mesh = !primitives.empty();
        if (has_mesh) append_element(meshes, "{\"primitives\":[" + primitives + "]}");
        append_element(nodes, node_json(mesh, i, has_mesh ? mesh_count++ : -1));
        if (mesh.nodes[i].parent < 0) append_element(roots, std::to_string(i));
    }
    for (const MeshMaterial& material : mesh.materials)
        append_element(materials, material_json(material));
    std::string json =
        "{\"asset\":{\"version\":\"2.0\",\"generator\":\"Harrier\"},\"scene\":0,\"scenes\":[{\"nodes\":[" +
        roots + "]}],\"nodes\":[" + nodes + "]";
    const auto add = [&json](const char* name, const std::string& array) {
        if (!array.empty()) json += std::string(",\"") + name + "\":[" + array + "]";
    };
    add("materials", materials);
    add("meshes", meshes);
    add("accessors", glb.accessors);
    add("bufferViews", glb.views);
    if (!glb.binary.empty()) add("buffers", "{\"byteLength\":" + std::to_string(glb.binary.size()) + "}");
    return json + "}";
}

}  // namespace

std::vector<char> glb_bytes(const PolygonMesh& mesh) {
    Glb glb;
    return pack_glb(document(mesh, glb), glb);
}

lod::Result<lod::Ok> write_glb(const std::string& path, const PolygonMesh& mesh) {
    const std::vector<char> bytes = glb_bytes(mesh);
    const std::string partial = path + ".part";
    std::ofstream file(partial, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file || std::rename(partial.c_str(), path.c_str()) != 0) {
        std::remove(partial.c_str());
        return lod::Error{path + ": cannot be written, expected a writable folder with room"};
    }
    return lod::Ok{};
}

}  // namespace data
