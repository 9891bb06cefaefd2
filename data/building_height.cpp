#include "data/building_height.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace data {

namespace {

constexpr double kFoot_m = 0.3048, kInch_m = 0.0254;
constexpr double kMinHeight_m = 0.5, kMaxHeight_m = 1000.0;

struct Unit {
    std::string_view name;
    double metres;
};
constexpr std::array kUnits{
    Unit{"", 1.0},         Unit{"m", 1.0},      Unit{"metre", 1.0},  Unit{"metres", 1.0},
    Unit{"meter", 1.0},    Unit{"meters", 1.0}, Unit{"ft", kFoot_m}, Unit{"foot", kFoot_m},
    Unit{"feet", kFoot_m}, Unit{"'", kFoot_m},  Unit{"\"", kInch_m}, Unit{"cm", 0.01},
};

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && text.front() == ' ')
        text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ')
        text.remove_suffix(1);
    return text;
}

/// Takes a number off the front of `text`; a comma is a decimal point.
std::optional<double> take_number(std::string_view& text) {
    size_t length = 0;
    while (length < text.size() &&
           (std::string_view("0123456789.,").find(text[length]) != std::string_view::npos))
        ++length;
    std::string digits(text.substr(0, length));
    std::replace(digits.begin(), digits.end(), ',', '.');
    double number = 0.0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc() || stop != digits.data() + digits.size()) return std::nullopt;
    text.remove_prefix(length);
    return number;
}

std::optional<double> unit_m(std::string_view name) {
    for (const Unit& unit : kUnits) {
        if (unit.name == name) return unit.metres;
    }
    return std::nullopt;
}

std::string_view first_of_list(std::string_view text) {
    return trimmed(text.substr(0, text.find(';')));
}

std::optional<double> sane(std::optional<double> height_m) {
    if (height_m && (*height_m < kMinHeight_m || *height_m > kMaxHeight_m)) return std::nullopt;
    return height_m;
}

/// Storeys in metres; a number without unit.
std::optional<double> storeys_m(std::string_view text, double storey_m) {
    std::string_view rest = first_of_list(text);
    const std::optional<double> count = take_number(rest);
    if (!count || !rest.empty()) return std::nullopt;
    return *count * storey_m;
}

}  // namespace

std::optional<double> parse_length_m(std::string_view text) {
    std::string_view rest = first_of_list(text);
    const std::optional<double> number = take_number(rest);
    if (!number) return std::nullopt;
    rest = trimmed(rest);
    if (rest.size() > 1 && rest.front() == '\'') {
        const std::optional<double> inches_m = parse_length_m(rest.substr(1));
        if (!inches_m || rest.back() != '"') return std::nullopt;
        return *number * kFoot_m + *inches_m;
    }
    const std::optional<double> metres = unit_m(rest);
    if (!metres) return std::nullopt;
    return *number * *metres;
}

BuildingHeight building_height(const BuildingTags& tags, double default_height_m, double storey_m) {
    const std::optional<double> stated = sane(parse_length_m(tags.height));
    const std::optional<double> counted = sane(storeys_m(tags.levels, storey_m));
    BuildingHeight result;
    result.has_height = stated.has_value();
    result.has_levels = counted.has_value();
    result.height_m = stated.value_or(counted.value_or(default_height_m));

    std::optional<double> underside = parse_length_m(tags.min_height);
    if (!underside) underside = storeys_m(tags.min_level, storey_m);
    if (underside && *underside < result.height_m) result.min_height_m = *underside;
    return result;
}

}  // namespace data
