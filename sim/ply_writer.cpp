#include "sim/ply_writer.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <unordered_map>

#include "lod/base/check.h"
#include "lod/base/hash.h"
#include "sim/whole_file.h"

namespace sim {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is written as memory has it");

/// A corner's bits and its module.
struct Corner {
    std::array<uint64_t, 3> bits{};
    uint8_t module = 0;
    bool operator==(const Corner&) const = default;
};

struct CornerHash {
    size_t operator()(const Corner& corner) const {
        uint64_t hash = corner.module;
        for (uint64_t bits : corner.bits)
            hash = lod::hash_combine(hash, bits);
        return static_cast<size_t>(hash);
    }
};

template <typename Value>
void append(std::string& bytes, const Value& value) {
    char raw[sizeof(Value)];
    std::memcpy(raw, &value, sizeof(Value));
    bytes.append(raw, sizeof(Value));
}

}  // namespace

PlyMesh merge_corners(const render::DrawnTriangles& triangles) {
    std::unordered_map<Corner, uint32_t, CornerHash> index_of;
    index_of.reserve(triangles.world.size());
    PlyMesh mesh;
    for (size_t i = 0; i < triangles.world.size(); ++i) {
        const auto module = static_cast<uint8_t>(triangles.module[i]);
        std::array<uint32_t, 3> face{};
        for (size_t corner = 0; corner < 3; ++corner) {
            const glm::dvec3 p = triangles.world[i][corner] + 0.0;  // -0 becomes 0
            const Corner key{
                {std::bit_cast<uint64_t>(p.x), std::bit_cast<uint64_t>(p.y), std::bit_cast<uint64_t>(p.z)},
                module};
            const auto [place, is_new] = index_of.emplace(key, static_cast<uint32_t>(mesh.vertices.size()));
            if (is_new) mesh.vertices.push_back(p);
            face[corner] = place->second;
        }
        mesh.faces.push_back(face);
        mesh.module.push_back(module);
    }
    return mesh;
}

lod::Result<lod::Ok> write_ply(const std::string& path, const PlyMesh& mesh) {
    CHECK(mesh.vertices.size() < (size_t{1} << 31) && mesh.module.size() == mesh.faces.size());
    std::string bytes = fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment module 0 terrain, 1 objects, 2 instruments\nelement "
        "vertex {}\n"
        "property double x\nproperty double y\nproperty double z\nelement face {}\n"
        "property list uchar int vertex_indices\nproperty uchar module\nend_header\n",
        mesh.vertices.size(), mesh.faces.size());
    bytes.reserve(bytes.size() + mesh.vertices.size() * 24 + mesh.faces.size() * 14);
    for (const glm::dvec3& p : mesh.vertices) {
        append(bytes, p.x);
        append(bytes, p.y);
        append(bytes, p.z);
    }
    for (size_t i = 0; i < mesh.faces.size(); ++i) {
        append(bytes, uint8_t{3});
        for (uint32_t corner : mesh.faces[i])
            append(bytes, static_cast<int32_t>(corner));
        append(bytes, mesh.module[i]);
    }
    return write_whole(path, bytes);
}

}  // namespace sim
