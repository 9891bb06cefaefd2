#include "data/model_truncation.h"

#include <algorithm>
#include <cstdint>

#include "data/ac3d_lines.h"
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

std::string length_text(size_t bytes, size_t wanted) {
    return "truncated: " + std::to_string(bytes) + " bytes; expected " + std::to_string(wanted) +
           ", as its header says";
}

std::optional<std::string> glb_problem(std::string_view content) {
    constexpr size_t kHeader_bytes = 12, kChunkHeader_bytes = 8;
    if (content.substr(0, 4) != "glTF") return "no binary glTF; expected glTF in its first bytes";
    if (content.size() < kHeader_bytes + kChunkHeader_bytes)
        return "truncated; expected a header of 20 bytes";
    const size_t length = little_endian(content, 8);
    if (length > content.size()) return length_text(content.size(), length);
    for (size_t at = kHeader_bytes; at < length;) {
        if (length - at < kChunkHeader_bytes) return "truncated; expected a chunk's header at its end";
        const size_t chunk_bytes = little_endian(content, at);
        at += kChunkHeader_bytes;
        if (chunk_bytes > length - at) return "truncated; expected a chunk as long as its header says";
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
        return "truncated; expected endsolid at the end of a text STL";
    }
    if (!has_header)
        return "truncated; expected a binary STL's header of 84 bytes, or solid as the first word of a text";
    if (wanted > content.size()) return length_text(content.size(), wanted);
    return std::nullopt;
}

/// Every object but the first is some object's kid, and every object ends with its count of kids, after its points
/// and surfaces.
std::optional<std::string> ac3d_problem(std::string_view content) {
    size_t objects = 0, kids = 0;
    bool is_open = false;
    while (!content.empty()) {
        const std::string_view line = take_ac3d_line(content);
        if (line.substr(0, 7) == "OBJECT ") {
            ++objects;
            is_open = true;
        }
        const bool has_count = line.substr(0, 5) == "kids " && line.find_first_of("0123456789") == 5;
        if (!has_count) continue;
        kids += ac3d_count(line);
        is_open = false;
    }
    if (objects == 0) return "no objects; expected AC3D";
    if (is_open) return "truncated in an object; expected a count of kids at its end";
    if (objects < kids + 1) {
        return "truncated: " + std::to_string(objects) + " objects; expected " + std::to_string(kids + 1) +
               " by their counts of kids";
    }
    return std::nullopt;
}

/// Text without a stated length: a last line without end may have been a longer one.
std::optional<std::string> last_line_problem(std::string_view content) {
    const std::string_view last = content.substr(content.find_last_of("\r\n") + 1);  // npos + 1 is 0
    const size_t word = last.find_first_not_of(" \t");
    if (word == std::string_view::npos || last[word] == '#') return std::nullopt;
    return "truncated, it seems: the last line has no end; expected a line break at the end of the file";
}

}  // namespace

std::optional<std::string> truncation_problem(std::string_view content, std::string_view extension) {
    if (content.empty()) return "empty file; expected a model";
    if (extension == "glb") return glb_problem(content);
    if (extension == "stl") return stl_problem(content);
    if (extension == "ply") return ply_problem(content);
    if (extension == "obj") return last_line_problem(content);
    if (is_ac3d(extension)) return ac3d_problem(content);
    return std::nullopt;
}

}  // namespace data
