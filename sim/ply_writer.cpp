#include "sim/ply_writer.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>
#include <unordered_map>

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

lod::Result<lod::Ok> write_ply(const std::string& path, const render::DrawnTriangles& triangles) {
    std::unordered_map<Corner, int32_t, CornerHash> index_of;
    index_of.reserve(triangles.world.size());
    std::string vertices, faces;
    faces.reserve(triangles.world.size() * 14);
    for (size_t i = 0; i < triangles.world.size(); ++i) {
        const auto module = static_cast<uint8_t>(triangles.module[i]);
        append(faces, uint8_t{3});
        for (const glm::dvec3& p : triangles.world[i]) {
            const glm::dvec3 q = p + 0.0;  // -0 becomes 0
            const Corner corner{
                {std::bit_cast<uint64_t>(q.x), std::bit_cast<uint64_t>(q.y), std::bit_cast<uint64_t>(q.z)},
                module};
            const auto [place, is_new] = index_of.emplace(corner, static_cast<int32_t>(index_of.size()));
            if (is_new) {
                append(vertices, q.x);
                append(vertices, q.y);
                append(vertices, q.z);
            }
            append(faces, place->second);
        }
        append(faces, module);
    }
    const std::string header = fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment world coordinates, metres; module 0 terrain, 1 "
        "objects, 2 "
        "instruments\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\nelement "
        "face {}\n"
        "property list uchar int vertex_indices\nproperty uchar module\nend_header\n",
        index_of.size(), triangles.world.size());
    return write_whole(path, header + vertices + faces);
}

}  // namespace sim
