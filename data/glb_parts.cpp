#include "data/glb_parts.h"

#include <cmath>
#include <cstdio>
#include <cstring>

namespace data {

namespace {

constexpr uint32_t kMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

void append_u32(uint32_t value, std::vector<char>& out) {
    for (int byte = 0; byte < 4; ++byte)
        out.push_back(static_cast<char>((value >> (8 * byte)) & 0xff));
}

}  // namespace

std::string json_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value == 0.0 ? 0.0 : value);
    return text;
}

std::string json_string(const std::string& text) {
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

double linear_from_srgb(float srgb) {
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

int append_accessor(const GlbAccessor& accessor, Glb& glb) {
    append_element(glb.accessors, "{\"bufferView\":" + std::to_string(accessor.view) +
                                      ",\"componentType\":" + std::to_string(accessor.component) +
                                      ",\"count\":" + std::to_string(accessor.count) + accessor.rest + "}");
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
            return "[" + json_number(double(v.x)) + "," + json_number(double(v.y)) + "," +
                   json_number(double(v.z)) + "]";
        };
        rest += ",\"min\":" + triple(low) + ",\"max\":" + triple(high);
    }
    const int view = append_view(vectors.data(), vectors.size() * sizeof(glm::vec3), kGlbVertices, glb);
    return append_accessor({view, kGlbFloat, vectors.size(), rest}, glb);
}

int append_indices(const std::vector<uint32_t>& indices, size_t vertex_count, Glb& glb) {
    const std::string rest = ",\"type\":\"SCALAR\"";
    if (vertex_count > 0xffff) {
        const int view = append_view(indices.data(), indices.size() * 4, kGlbIndices, glb);
        return append_accessor({view, kGlbUint32, indices.size(), rest}, glb);
    }
    std::vector<uint16_t> narrow;
    for (uint32_t index : indices)
        narrow.push_back(static_cast<uint16_t>(index));
    const int view = append_view(narrow.data(), narrow.size() * 2, kGlbIndices, glb);
    return append_accessor({view, kGlbUint16, narrow.size(), rest}, glb);
}

std::vector<char> pack_glb(std::string json, const Glb& glb) {
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

}  // namespace data
