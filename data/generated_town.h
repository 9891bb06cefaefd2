// A generated town: streets on a slightly bent grid, a square with a church, courtyards, terraces, houses.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace data {

/// One building of a town. Rings are open; the outer is counter-clockwise, courtyards clockwise.
struct TownBuilding {
    std::vector<std::vector<glm::dvec2>> rings;  ///< metres east and north of the town's middle
    double height_m = 0.0;
};

/// A straight piece of street between two crossings.
struct TownStreet {
    glm::dvec2 from{0.0}, to{0.0};  ///< metres east and north of the town's middle
};

struct TownOptions {
    uint64_t seed = 1;
    double radius_m = 540.0;  ///< where the last houses stand
    double street_width_m = 11.0;
};

/// Buildings of a town, blocks in rows, none overlapping another. The same for equal options on every machine
/// but for the last bits of sine and cosine. About 750 buildings for the default radius.
std::vector<TownBuilding> generate_town(const TownOptions& options);

/// The streets around all blocks with buildings, each piece once; `street_width_m` wide from house to house.
std::vector<TownStreet> generate_streets(const TownOptions& options);

}  // namespace data
