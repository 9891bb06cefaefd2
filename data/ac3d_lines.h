// The lines of an AC3D file, without the free text that objects may carry.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace data {

/// The number after a line's keyword; 0 where there is none.
inline uint32_t ac3d_count(std::string_view line) {
    line.remove_prefix(std::min(line.find(' '), line.size()));
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    uint32_t count = 0;
    std::from_chars(line.data(), line.data() + line.size(), count);
    return count;
}

/// Takes the next line off the front of `rest`. After `data N`, N characters on the next lines are free text and
/// are taken with it.
inline std::string_view take_ac3d_line(std::string_view& rest) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    const size_t free_text = line.substr(0, 5) == "data " ? ac3d_count(line) : 0;
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    rest.remove_prefix(std::min(free_text, rest.size()));
    return line;
}

}  // namespace data
