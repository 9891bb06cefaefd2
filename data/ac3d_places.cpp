#include "data/ac3d_places.h"

#include <algorithm>
#include <charconv>

#include "data/ac3d_lines.h"

namespace data {

namespace {

/// Three numbers; what cannot be read stays 0.
glm::dvec3 numbers_of(std::string_view text) {
    glm::dvec3 numbers(0.0);
    for (int i = 0; i < 3; ++i) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
        const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), numbers[i]);
        if (error != std::errc()) break;
        text.remove_prefix(static_cast<size_t>(stop - text.data()));
    }
    return numbers;
}

}  // namespace

std::vector<glm::dvec3> ac3d_places(std::string_view content) {
    std::vector<glm::dvec3> places;
    while (!content.empty()) {
        const std::string_view line = take_ac3d_line(content);
        if (line.substr(0, 7) == "OBJECT ") places.emplace_back(0.0);
        if (line.substr(0, 4) == "loc " && !places.empty()) places.back() = numbers_of(line.substr(4));
    }
    return places;
}

}  // namespace data
