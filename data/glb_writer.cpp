#include "data/glb_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>

namespace data {

namespace {

constexpr uint32_t kMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;
constexpr int kUint16 = 5123, kUint32 = 5125, kFloat = 5126;
constexpr int kVertexTarget = 34962, kIndexTarget = 34963;

/// The two halves of a GLB while it grows.
struct Glb {
    std::vector<char> binary;
    std::string views, accessors;  ///< JSON array elements
    int view_count = 0, accessor_count = 0;
};

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value == 0.0 ? 0.0 : value);
    return text;
}

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return out + "\"";
}

void append_element(std::string& array, const std::string& element) {
    if (!array.empty()) array += ",";
    array += element;
}

/// glTF colours are linear.
double linear(float srgb) {
    const double value = static_cast<double>(srgb);
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

int append_view(const void* bytes, size_t size, int target, Glb& glb) {
    const size_t offset = glb.binary.size();
    glb.binary.resize(offset + (size + 3) / 4 * 4);
    if (size > 0) std::memcpy(glb.binary.data() + offset, bytes, size);
    append_element(glb.views, "{\"buffer\":0,\"byteOffset\":" + std::to_string(offset) + ",\"byteLength\":" +
                                  std::to_string(size) + ",\"target\":" + std::to_string(target) + "}");
    return glb.view_count++;
}

int append_accessor(int view, int type, size_t count, const std::string& rest, Glb& glb) {
    append_element(glb.accessors, "{\"bufferView\":" + std::to_string(view) +
                                      ",\"componentType\":" + std::to_string(type) +
                                      ",\"count\":" + std::to_string(count) + rest + "}");
    return glb.accessor_count++;
}

int append_vectors(const std::vector<glm::vec3>& vectors, bool with_bounds, Glb& glb) {
    std::string rest = ",\"type\":\"VEC3\"";
    if (with_bounds) {
        glm::vec3 low = vectors[0], high = vectors[0];
        for (const glm::vec3& vector : vectors) {
            low = glm::min(low, vector);
            high = glm::max(high, vector);
        }
        const auto triple = [](const glm::vec3& v) {
            return "[" + number(double(v.x)) + "," + number(double(v.y)) + "," + number(double(v.z)) + "]";
        };
        rest += ",\"min\":" + triple(low) + ",\"max\":" + triple(high);
    }
    const int view = append_view(vectors.data(), vectors.size() * sizeof(glm::vec3), kVertexTarget, glb);
    return append_accessor(view, kFloat, vectors.size(), rest, glb);
}

/// 16 bits where the vertices allow it.
int append_indices(const std::vector<uint32_t>& indices, size_t vertex_count, Glb& glb) {
    const std::string rest = ",\"type\":\"SCALAR\"";
    if (vertex_count > 0xffff) {
        const int view = append_view(indices.data(), indices.size() * 4, kIndexTarget, glb);
        return append_accessor(view, kUint32, indices.size(), rest, glb);
    }
    std::vector<uint16_t> narrow;
    for (uint32_t index : indices)
        narrow.push_back(static_cast<uint16_t>(index));
    const int view = append_view(narrow.data(), narrow.size() * 2, kIndexTarget, glb);
    return append_accessor(view, kUint16, narrow.size(), rest, glb);
}

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
    const std::string colour = number(linear(c.x)) + "," + number(linear(c.y)) + "," + number(linear(c.z));
    std::string json = "{\"name\":" + quoted(material.name) +
                       ",\"pbrMetallicRoughness\":{\"baseColorFactor\":[" + colour + "," +
                       number(double(c.w)) + "],\"metallicFactor\":0,\"roughnessFactor\":0.6}";
    if (c.w < 1.0f) json += ",\"alphaMode\":\"BLEND\"";
    if (material.emission > 0.0f) {
        const std::string glow = number(double(material.emission));
        json += ",\"emissiveFactor\":[" + glow + "," + glow + "," + glow + "]";
    }
    return json + "}";
}

std::string matrix_json(const glm::dmat4& matrix) {
    std::string json;
    for (int col = 0; col < 4; ++col) {
        for (int row = 0; row < 4; ++row)
            append_element(json, number(matrix[col][row]));
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
    std::string json = "{\"name\":" + quoted(node.name);
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

void append_u32(uint32_t value, std::vector<char>& out) {
    for (int byte = 0; byte < 4; ++byte)
        out.push_back(static_cast<char>((value >> (8 * byte)) & 0xff));
}

}  // namespace

std::vector<char> glb_bytes(const PolygonMesh& mesh) {
    Glb glb;
    std::string json = document(mesh, glb);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const bool has_binary = !glb.binary.empty();
    const size_t total = 12 + 8 + json.size() + (has_binary ? 8 + glb.binary.size() : 0);
    std::vector<char> out;
    for (const uint32_t word : {kMagic, 2u, static_cast<uint32_t>(total)})
        append_u32(word, out);
    append_u32(static_cast<uint32_t>(json.size()), out);
    append_u32(kJsonChunk, out);
    out.insert(out.end(), json.begin(), json.end());
    if (!has_binary) return out;
    append_u32(static_cast<uint32_t>(glb.binary.size()), out);
    append_u32(kBinaryChunk, out);
    out.insert(out.end(), glb.binary.begin(), glb.binary.end());
    return out;
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
