#include "data/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

namespace data {

namespace {

struct TypeSize {
    std::string_view name;
    uint64_t bytes;
};
constexpr std::array kTypes{
    TypeSize{"char", 1},  TypeSize{"uchar", 1},   TypeSize{"int8", 1},   TypeSize{"uint8", 1},
    TypeSize{"short", 2}, TypeSize{"ushort", 2},  TypeSize{"int16", 2},  TypeSize{"uint16", 2},
    TypeSize{"int", 4},   TypeSize{"uint", 4},    TypeSize{"int32", 4},  TypeSize{"uint32", 4},
    TypeSize{"float", 4}, TypeSize{"float32", 4}, TypeSize{"double", 8}, TypeSize{"float64", 8},
};

/// 0 where there is no such type.
uint64_t bytes_of(std::string_view name) {
    for (const TypeSize& type : kTypes) {
        if (type.name == name) return type.bytes;
    }
    return 0;
}

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    constexpr std::string_view kBlank = " \t\r";
    for (size_t at = line.find_first_not_of(kBlank); at != std::string_view::npos;) {
        const size_t end = std::min(line.find_first_of(kBlank, at), line.size());
        words.push_back(line.substr(at, end - at));
        at = line.find_first_not_of(kBlank, end);
    }
    return words;
}

struct PlyProperty {
    uint64_t count_bytes = 0;  ///< of a list's length; 0: not a list
    uint64_t bytes = 0;        ///< of one value
};

struct PlyElement {
    uint64_t count = 0;
    std::vector<PlyProperty> properties{};

    bool has_list() const {
        return std::any_of(properties.begin(), properties.end(),
                           [](const PlyProperty& property) { return property.count_bytes > 0; });
    }
};

/// What must follow the header, as far as it is read.
struct PlyLength {
    bool is_text = false, is_big_endian = false, has_format = false;
    std::vector<PlyElement> elements;
};

std::optional<std::string> take_element(const std::vector<std::string_view>& words, PlyLength& length) {
    uint32_t count = 0;
    if (words.size() < 3) return "an element without a count; expected: element name count";
    const char* end = words[2].data() + words[2].size();
    const auto [stop, error] = std::from_chars(words[2].data(), end, count);
    if (error != std::errc() || stop != end)
        return "an element whose count is not a number; expected 0 to 4294967295";
    length.elements.push_back({count});
    return std::nullopt;
}

std::optional<std::string> take_property(const std::vector<std::string_view>& words, PlyLength& length) {
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (!is_list && words.size() != 3) return "not a property; expected: property [list type] type name";
    if (length.elements.empty()) return "a property; expected an element before it";
    PlyProperty property{is_list ? bytes_of(words[2]) : 0, bytes_of(words[is_list ? 3 : 1])};
    if (property.bytes == 0 || (is_list && property.count_bytes == 0))
        return "a property of unknown type; expected char to double, or int8 to float64";
    length.elements.back().properties.push_back(property);
    return std::nullopt;
}

std::optional<std::string> take_line(const std::vector<std::string_view>& words, PlyLength& length) {
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return std::nullopt;
    if (words[0] == "format" && words.size() == 3) {
        length.has_format = true;
        length.is_text = words[1] == "ascii";
        length.is_big_endian = words[1] == "binary_big_endian";
        if (length.is_text || length.is_big_endian || words[1] == "binary_little_endian") return std::nullopt;
    }
    if (words[0] == "element") return take_element(words, length);
    if (words[0] == "property") return take_property(words, length);
    return "a line that PLY does not know; expected format, element, property or comment";
}

/// Takes one value, or a list's length and its values. @returns whether they are there
bool take_value(std::string_view& body, const PlyProperty& property, bool is_big_endian) {
    uint64_t values = property.count_bytes == 0 ? 1 : 0;
    if (property.count_bytes > body.size()) return false;
    for (size_t i = 0; i < property.count_bytes; ++i) {
        const size_t at = is_big_endian ? i : static_cast<size_t>(property.count_bytes) - 1 - i;
        values = values << 8 | static_cast<unsigned char>(body[at]);
    }
    body.remove_prefix(static_cast<size_t>(property.count_bytes));
    if (values > body.size() / property.bytes) return false;
    body.remove_prefix(static_cast<size_t>(values * property.bytes));
    return true;
}

bool take_element_data(std::string_view& body, const PlyElement& element, bool is_big_endian) {
    if (!element.has_list()) {
        uint64_t bytes = 0;
        for (const PlyProperty& property : element.properties)
            bytes += property.bytes;
        if (bytes > 0 && element.count > body.size() / bytes) return false;
        body.remove_prefix(static_cast<size_t>(element.count * bytes));
        return true;
    }
    for (uint64_t i = 0; i < element.count; ++i) {
        for (const PlyProperty& property : element.properties) {
            if (!take_value(body, property, is_big_endian)) return false;
        }
    }
    return true;
}

/// Text has an element on each line; a last line without end may have been a longer one.
std::optional<std::string> body_problem(std::string_view body, const PlyLength& length) {
    const std::string problem = "truncated; expected as many elements as its header says";
    if (!length.is_text) {
        for (const PlyElement& element : length.elements) {
            if (!take_element_data(body, element, length.is_big_endian)) return problem;
        }
        return std::nullopt;
    }
    uint64_t wanted = 0;
    for (const PlyElement& element : length.elements)
        wanted += element.count;
    const auto lines = static_cast<uint64_t>(std::count(body.begin(), body.end(), '\n'));
    if (wanted <= lines) return std::nullopt;
    return wanted > lines + 1 ? problem
                              : "truncated, it seems: the last line has no end; expected a line break";
}

}  // namespace

std::optional<std::string> ply_problem(std::string_view content) {
    PlyLength length;
    for (size_t at = 0, line_number = 1; at < content.size(); ++line_number) {
        const size_t end = content.find('\n', at);
        if (end == std::string_view::npos) break;
        const std::vector<std::string_view> words = words_of(content.substr(at, end - at));
        at = end + 1;
        if (line_number == 1) {
            if (words.size() != 1 || words[0] != "ply") return "not a PLY; expected ply as its first line";
        } else if (words.size() == 1 && words[0] == "end_header") {
            if (!length.has_format)
                return "the PLY header states no format; expected ascii or binary_little_endian";
            return body_problem(content.substr(at), length);
        } else if (const std::optional<std::string> problem = take_line(words, length)) {
            return "PLY header, line " + std::to_string(line_number) + ": " + *problem;
        }
    }
    return "not a PLY, or truncated in its header; expected end_header";
}

}  // namespace data
