#include "data/model_truncation.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "data/ac3d_places.h"
#include "data/ply_header.h"

namespace data {

namespace {

uint32_t little_endian(std::string_view content, size_t at) {
    uint32_t value = 0;
    for (size_t i = 4; i-- > 0;)
        value = value << 8 | static_cast<unsigned char>(content[at + i]);
    return value;
}

std::optional<std::string> glb_problem(std::string_view content) {
    constexpr size_t kHeader_bytes = 12, kChunkHeader_bytes = 8;
    if (content.substr(0, 4) != "glTF") return "not a binary glTF";
    if (content.size() < kHeader_bytes + kChunkHeader_bytes) return "truncated in its header";
    const size_t length = little_endian(content, 8);
    if (length > content.size()) return "truncated: shorter than its header says";
    for (size_t at = kHeader_bytes; at < length;) {
        if (length - at < kChunkHeader_bytes) return "truncated in a chunk's header";
        const size_t chunk_bytes = little_endian(content, at);
        at += kChunkHeader_bytes;
        if (chunk_bytes > length - at) return "truncated: a chunk is longer than the file";
        at += chunk_bytes;
    }
    return std::nullopt;
}

std::optional<std::string> stl_problem(std::string_view content) {
    constexpr size_t kHeader_bytes = 84, kFacet_bytes = 50, kTail_bytes = 1024;
    const bool has_header = content.size() >= kHeader_bytes;
    const size_t wanted = has_header ? kHeader_bytes + kFacet_bytes * size_t{little_endian(content, 80)} : 0;
    if (has_header && wanted == content.size())
        return std::nullopt;  // binary, even if it begins with `solid`
    if (content.substr(0, 5) == "solid") {
        const size_t tail = content.size() - std::min(content.size(), kTail_bytes);
        if (content.find("endsolid", tail) != std::string_view::npos) return std::nullopt;
        return "truncated: a text STL without endsolid";
    }
    if (!has_header) return "truncated: shorter than a binary STL's header";
    if (wanted > content.size()) return "truncated: fewer facets than its header says";
    return std::nullopt;
}

/// Every object but the first is some object's kid.
std::optional<std::string> ac3d_problem(std::string_view content) {
    uint64_t objects = 0, kids = 0;
    for (size_t at = 0; at < content.size();) {
        const size_t end = std::min(content.find('\n', at), content.size());
        const std::string_view line = content.substr(at, end - at);
        at = end + 1;
        if (line.substr(0, 7) == "OBJECT ") ++objects;
        if (line.substr(0, 5) != "kids ") continue;
        uint32_t count = 0;
        std::from_chars(line.data() + 5, line.data() + line.size(), count);
        kids += count;
    }
    if (objects == 0) return "no objects; expected AC3D";
    if (objects < kids + 1) return "truncated: fewer objects than its counts of kids say";
    return std::nullopt;
}

}  // namespace

std::optional<std::string> truncation_problem(std::string_view content, std::string_view extension) {
    if (content.empty()) return "empty file";
    if (extension == "glb") return glb_problem(content);
    if (extension == "stl") return stl_problem(content);
    if (extension == "ply") return ply_problem(content);
    if (is_ac3d(extension)) return ac3d_problem(content);
    return std::nullopt;
}

}  // namespace data
