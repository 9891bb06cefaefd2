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

/// What must follow the header, as far as it is read.
struct PlyLength {
    bool is_text = false, has_format = false;
    uint64_t element_count = 0, element_bytes = 0;  ///< of the element that is being described
    uint64_t total_count = 0, total_bytes = 0;

    void close_element() {
        total_count += element_count;
        total_bytes += element_count * element_bytes;
        element_count = element_bytes = 0;
    }
};

std::optional<std::string> take_element(const std::vector<std::string_view>& words, PlyLength& length) {
    length.close_element();
    uint32_t count = 0;
    if (words.size() < 3) return "an element without a count";
    const char* end = words[2].data() + words[2].size();
    const auto [stop, error] = std::from_chars(words[2].data(), end, count);
    if (error != std::errc() || stop != end) return "an element whose count is not a number";
    length.element_count = count;
    return std::nullopt;
}

std::optional<std::string> take_property(const std::vector<std::string_view>& words, PlyLength& length) {
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (!is_list && words.size() != 3)
        return "a property that is not of the form: property [list type] type name";
    for (const TypeSize& type : kTypes) {
        if (type.name != words[is_list ? 2 : 1]) continue;
        length.element_bytes += type.bytes;
        return std::nullopt;
    }
    return "a property of unknown type";
}

std::optional<std::string> take_line(const std::vector<std::string_view>& words, PlyLength& length) {
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return std::nullopt;
    if (words[0] == "format" && words.size() == 3) {
        length.has_format = true;
        length.is_text = words[1] == "ascii";
        const bool is_known =
            length.is_text || words[1] == "binary_little_endian" || words[1] == "binary_big_endian";
        if (is_known) return std::nullopt;
    }
    if (words[0] == "element") return take_element(words, length);
    if (words[0] == "property") return take_property(words, length);
    return "a line that PLY does not know";
}

bool is_long_enough(std::string_view body, const PlyLength& length) {
    if (!length.is_text) return length.total_bytes <= body.size();
    const auto lines = static_cast<uint64_t>(std::count(body.begin(), body.end(), '\n'));
    return length.total_count <= lines + 1;  // the last may lack its end
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
            if (words.size() != 1 || words[0] != "ply")
                return "not a PLY: expected its first line to be: ply";
        } else if (words.size() == 1 && words[0] == "end_header") {
            length.close_element();
            if (!length.has_format) return "the PLY header states no format";
            if (!is_long_enough(content.substr(at), length))
                return "truncated: fewer elements than its header says";
            return std::nullopt;
        } else if (const std::optional<std::string> problem = take_line(words, length)) {
            return "PLY header, line " + std::to_string(line_number) + ": " + *problem;
        }
    }
    return "not a PLY, or truncated in its header";
}

}  // namespace data
