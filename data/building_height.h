// How high a building is, from what its tags say.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace data {

/// A feature's tags as text; empty where the source has none.
struct BuildingTags {
    std::string height;      ///< height, building:height
    std::string levels;      ///< building:levels
    std::string min_height;  ///< min_height
    std::string min_level;   ///< building:min_level
};

/// Metres of a length as mappers write it: `12`, `12.5 m`, `12,5`, `40 ft`, `40'`, `5'10"`; of a list such as `3;4`
/// the first. Empty for anything else, and for what is negative or not finite.
std::optional<double> parse_length_m(std::string_view text);

/// What the tags come to.
struct BuildingHeight {
    double height_m = 0.0;      ///< roof above the ground, [0.5, 1000]
    double min_height_m = 0.0;  ///< underside above the ground, [0, height_m)
    bool has_height = false;    ///< a usable height was given: it decides
    bool has_levels = false;    ///< a usable number of storeys was given
};

/// The height where it is usable, else storeys, else the default; values outside [0.5, 1000] m are not usable. An
/// underside at or above the roof counts as none.
/// @param default_height_m, storey_m  within [0.5, 1000]
BuildingHeight building_height(const BuildingTags& tags, double default_height_m, double storey_m);

}  // namespace data
