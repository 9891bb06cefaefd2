#include "data/fbx_node.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace data {

namespace {

constexpr std::string_view kMagic("Kaydara FBX Binary  \0\x1a\0", 23);
constexpr uint32_t kVersion = 7400;
constexpr size_t kZipFrom = 256;  // bytes of an array
constexpr int kMaxDepth = 64;

template <typename T>
void put(T value, std::string& out) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    out.append(bytes, sizeof(T));
}

void put_array(char kind, const void* values, size_t count, size_t size, std::string& out) {
    const size_t raw = count * size;
    out += kind;
    put(static_cast<uint32_t>(count), out);
    if (raw >= kZipFrom) {
        uLongf packed = compressBound(raw);
        std::string bytes(packed, '\0');
        if (compress2(reinterpret_cast<Bytef*>(bytes.data()), &packed, static_cast<const Bytef*>(values), raw,
                      1) == Z_OK &&
            packed < raw) {
            put(uint32_t{1}, out);
            put(static_cast<uint32_t>(packed), out);
            out.append(bytes, 0, packed);
            return;
        }
    }
    put(uint32_t{0}, out);
    put(static_cast<uint32_t>(raw), out);
    out.append(static_cast<const char*>(values), raw);
}

void put_property(const FbxProperty& property, std::string& out) {
    std::visit(
        [&](const auto& value) {
            using T = std::decay_t<decltype(value)>;
            if constexpr (std::is_same_v<T, std::string>) {
                out += 'S';
                put(static_cast<uint32_t>(value.size()), out);
                out += value;
            } else if constexpr (std::is_arithmetic_v<T>) {
                out += std::is_same_v<T, int32_t> ? 'I' : std::is_same_v<T, int64_t> ? 'L' : 'D';
                put(value, out);
            } else {
                using E = typename T::value_type;
                const char kind = std::is_same_v<E, int32_t>   ? 'i'
                                  : std::is_same_v<E, int64_t> ? 'l'
                                  : std::is_same_v<E, float>   ? 'f'
                                                               : 'd';
                put_array(kind, value.data(), value.size(), sizeof(E), out);
            }
        },
        property);
}

/// What other programs expect behind the records.
void put_footer(std::string& out) {
    constexpr std::string_view kId("\xfa\xbc\xab\x09\xd0\xc8\xd4\x66\xb1\x76\xfb\x83\x1c\xf7\x26\x7e", 16);
    constexpr std::string_view kEnd("\xf8\x5a\x8c\x6a\xde\xf5\xd9\x7e\xec\xe9\x0c\xe3\x75\x8f\x29\x0b", 16);
    out += kId;
    out.append(4, '\0');
    out.append(16 - out.size() % 16, '\0');
    put(kVersion, out);
    out.append(120, '\0');
    out += kEnd;
}

/// A cursor over the bytes that never leaves them: `is_good` turns false instead.
struct Cursor {
    std::string_view bytes;
    size_t at = 0;
    bool is_good = true;

    template <typename T>
    T take() {
        T value{};
        if (bytes.size() - at < sizeof(T)) {
            is_good = false;
            return value;
        }
        std::memcpy(&value, bytes.data() + at, sizeof(T));
        at += sizeof(T);
        return value;
    }
    std::string_view take_bytes(size_t count) {
        if (bytes.size() - at < count) {
            is_good = false;
            return {};
        }
        at += count;
        return bytes.substr(at - count, count);
    }
};

template <typename T>
std::vector<T> take_array(Cursor& cursor) {
    const auto count = cursor.take<uint32_t>(), encoding = cursor.take<uint32_t>(),
               size = cursor.take<uint32_t>();
    const std::string_view bytes = cursor.take_bytes(size);
    const size_t raw = size_t{count} * sizeof(T);
    if (!cursor.is_good ||
        (encoding == 0 ? bytes.size() != raw : raw / 1100 > bytes.size())) {  // zlib's best is 1:1032
        cursor.is_good = false;
        return {};
    }
    std::vector<T> values(count);
    uLongf unpacked = raw;
    if (encoding == 0) {
        if (raw > 0) std::memcpy(values.data(), bytes.data(), raw);
    } else if (uncompress(reinterpret_cast<Bytef*>(values.data()), &unpacked,
                          reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()) != Z_OK ||
               unpacked != raw) {
        cursor.is_good = false;
    }
    return values;
}

FbxProperty take_property(Cursor& cursor) {
    switch (cursor.take<char>()) {
        case 'C':
            return int32_t{cursor.take<int8_t>()};
        case 'Y':
            return int32_t{cursor.take<int16_t>()};
        case 'I':
            return cursor.take<int32_t>();
        case 'L':
            return cursor.take<int64_t>();
        case 'F':
            return static_cast<double>(cursor.take<float>());
        case 'D':
            return cursor.take<double>();
        case 'S':
        case 'R':
            return std::string(cursor.take_bytes(cursor.take<uint32_t>()));
        case 'b': {
            const std::vector<int8_t> flags = take_array<int8_t>(cursor);
            return std::vector<int32_t>(flags.begin(), flags.end());
        }
        case 'i':
            return take_array<int32_t>(cursor);
        case 'l':
            return take_array<int64_t>(cursor);
        case 'f':
            return take_array<float>(cursor);
        case 'd':
            return take_array<double>(cursor);
        default:
            cursor.is_good = false;
            return int32_t{0};
    }
}

/// Reads records until the empty one, or until `end`.
void take_nodes(Cursor& cursor, size_t end, bool is_wide, int depth, std::vector<FbxNode>& out) {
    if (depth > kMaxDepth) cursor.is_good = false;
    const auto take_size = [&] {
        return is_wide ? cursor.take<uint64_t>() : uint64_t{cursor.take<uint32_t>()};
    };
    while (cursor.is_good && cursor.at < end) {
        const uint64_t node_end = take_size(), count = take_size();
        take_size();
        const std::string_view name = cursor.take_bytes(cursor.take<uint8_t>());
        if (node_end == 0) return;
        if (!cursor.is_good || node_end < cursor.at || node_end > end) {
            cursor.is_good = false;
            return;
        }
        FbxNode& node = out.emplace_back();
        node.name = name;
        for (uint64_t i = 0; i < count && cursor.is_good; ++i)
            node.properties.push_back(take_property(cursor));
        if (cursor.is_good && cursor.at < node_end)
            take_nodes(cursor, node_end, is_wide, depth + 1, node.children);
        if (cursor.at != node_end) cursor.is_good = false;
    }
    if (depth == 0) cursor.is_good = false;  // the file's last record is an empty one
}

}  // namespace

const FbxNode* find_child(const FbxNode& node, std::string_view name) {
    const auto found = std::find_if(node.children.begin(), node.children.end(),
                                    [&](const FbxNode& child) { return child.name == name; });
    return found == node.children.end() ? nullptr : &*found;
}

const std::string* text_at(const FbxNode& node, size_t index) {
    return index < node.properties.size() ? std::get_if<std::string>(&node.properties[index]) : nullptr;
}

std::optional<int64_t> integer_at(const FbxNode& node, size_t index) {
    if (index >= node.properties.size()) return std::nullopt;
    if (const auto* value = std::get_if<int64_t>(&node.properties[index])) return *value;
    if (const auto* value = std::get_if<int32_t>(&node.properties[index])) return *value;
    return std::nullopt;
}

double number_at(const FbxNode& node, size_t index, double otherwise) {
    if (index < node.properties.size()) {
        if (const auto* value = std::get_if<double>(&node.properties[index])) return *value;
    }
    const auto whole = integer_at(node, index);
    return whole ? static_cast<double>(*whole) : otherwise;
}

std::string plain_name(const std::string& name) {
    const size_t end = name.find('\0');
    return end == std::string::npos ? name : name.substr(0, end);
}

void begin_fbx_file(std::string& out) {
    out = kMagic;
    put(kVersion, out);
}

void append_fbx_node(const FbxNode& node, std::string& out) {
    const size_t begin = out.size();
    out.append(12, '\0');  // filled in below
    out += static_cast<char>(node.name.size());
    out += node.name;
    const size_t properties = out.size();
    for (const FbxProperty& property : node.properties)
        put_property(property, out);
    const uint32_t sizes[] = {static_cast<uint32_t>(node.properties.size()),
                              static_cast<uint32_t>(out.size() - properties)};
    std::memcpy(out.data() + begin + 4, sizes, sizeof sizes);
    for (const FbxNode& child : node.children)
        append_fbx_node(child, out);
    if (!node.children.empty() || node.properties.empty()) out.append(13, '\0');
    const auto end = static_cast<uint32_t>(out.size());
    std::memcpy(out.data() + begin, &end, sizeof end);
}

size_t begin_fbx_node(std::string_view name, std::string& out) {
    const size_t begin = out.size();
    out.append(12, '\0');
    out += static_cast<char>(name.size());
    out += name;
    return begin;
}

void end_fbx_node(size_t begin, std::string& out) {
    out.append(13, '\0');
    const auto end = static_cast<uint32_t>(out.size());
    std::memcpy(out.data() + begin, &end, sizeof end);
}

void end_fbx_file(std::string& out) {
    out.append(13, '\0');
    put_footer(out);
}

lod::Result<std::vector<FbxNode>> parse_fbx(std::string_view bytes, const std::string& path) {
    if (bytes.size() < kMagic.size() || !bytes.starts_with(kMagic.substr(0, 21)))
        return lod::Error{path + ": no binary FBX, expected one of version 7"};
    Cursor cursor{bytes, kMagic.size()};
    const auto version = cursor.take<uint32_t>();
    if (!cursor.is_good || version < 7000 || version > 8000)
        return lod::Error{path + ": FBX of version " + std::to_string(version) + ", expected 7000 to 8000"};
    std::vector<FbxNode> top;
    take_nodes(cursor, bytes.size(), version >= 7500, 0, top);
    if (!cursor.is_good)
        return lod::Error{path + ": broken at byte " + std::to_string(cursor.at) +
                          ", expected a whole FBX file"};
    return top;
}

}  // namespace data
