#include "data/generated_town.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "lod/base/rng.h"

namespace data {

namespace {

constexpr double kBlockEastM = 96.0, kBlockNorthM = 78.0;    // between the middles of neighbouring streets
constexpr double kTurnRad = 0.42;                            // of the whole plan: streets follow the valley
constexpr double kCentreShare = 0.36, kTerraceShare = 0.72;  // of the radius: where the kinds of block change

/// The four corners of a block, counter-clockwise; u runs from [0] to [1], v from [0] to [3].
using Block = std::array<glm::dvec2, 4>;

struct Builder {
    const TownOptions& options;
    std::vector<TownBuilding>& out;
};

glm::dvec2 at(const Block& block, double u, double v) {
    return glm::mix(glm::mix(block[0], block[1], u), glm::mix(block[3], block[2], u), v);
}

/// The part of a block between two u and two v.
Block part(const Block& block, double u0, double u1, double v0, double v1) {
    return {at(block, u0, v0), at(block, u1, v0), at(block, u1, v1), at(block, u0, v1)};
}

double width_of(const Block& block) {
    return glm::distance(at(block, 0.0, 0.5), at(block, 1.0, 0.5));
}
double depth_of(const Block& block) {
    return glm::distance(at(block, 0.5, 0.0), at(block, 0.5, 1.0));
}

/// The block less a strip along all sides.
Block inset(const Block& block, double strip_m) {
    const double u = strip_m / width_of(block), v = strip_m / depth_of(block);
    return part(block, u, 1.0 - u, v, 1.0 - v);
}

/// Where the crossing (column, row) of two streets lies: a turned grid, gently bent, each crossing a bit off.
glm::dvec2 crossing(int col, int row, uint64_t seed) {
    lod::Rng rng(lod::hash_combine(lod::hash_combine(seed, static_cast<uint64_t>(col + 1000)),
                                   static_cast<uint64_t>(row + 1000)));
    glm::dvec2 p(kBlockEastM * col, kBlockNorthM * row);
    p += glm::dvec2(26.0 * std::sin(p.y / 210.0 + 0.7), 22.0 * std::sin(p.x / 260.0));
    const double east = rng.between(-5.0, 5.0), north = rng.between(-5.0, 5.0);
    p += glm::dvec2(east, north);
    const double c = std::cos(kTurnRad), s = std::sin(kTurnRad);
    return {c * p.x - s * p.y, s * p.x + c * p.y};
}

void append(const Block& ring, double height_m, const Builder& town) {
    town.out.push_back({{{ring[0], ring[1], ring[2], ring[3]}}, std::round(height_m * 10.0) / 10.0});
}

/// An L: the lot less its far corner.
void append_corner(const Block& lot, double height_m, const Builder& town) {
    town.out.push_back({{{at(lot, 0, 0), at(lot, 1, 0), at(lot, 1, 0.45), at(lot, 0.5, 0.45), at(lot, 0.5, 1),
                          at(lot, 0, 1)}},
                        std::round(height_m * 10.0) / 10.0});
}

/// One building around a courtyard.
void append_courtyard(const Block& block, double height_m, lod::Rng& rng, const Builder& town) {
    const Block yard = inset(block, rng.between(11.0, 14.0));
    append(block, height_m, town);
    town.out.back().rings.push_back({yard[0], yard[3], yard[2], yard[1]});
}

/// Houses wall to wall along the two long sides, gardens between.
void append_terraces(const Block& block, double low_m, double high_m, lod::Rng& rng, const Builder& town) {
    const int houses = std::max(2, static_cast<int>(width_of(block) / 15.0));
    for (const bool is_far : {false, true}) {
        double u = 0.0;
        for (int house = 0; house < houses; ++house) {
            const double end = house + 1 == houses ? 1.0 : (house + rng.between(0.85, 1.15)) / houses;
            const double depth = rng.between(11.0, 16.0) / depth_of(block);
            const Block lot =
                is_far ? part(block, u, end, 1.0 - depth, 1.0) : part(block, u, end, 0.0, depth);
            u = end;
            const double height_m = rng.between(low_m, high_m);
            if (rng.unit() < 0.08) continue;  // a gap with trees
            append(lot, height_m, town);
        }
    }
}

/// A free-standing house in its garden, turned a little.
void append_house(const Block& lot, lod::Rng& rng, const Builder& town) {
    const double u = rng.between(0.16, 0.24), v = rng.between(0.2, 0.3);
    const Block house = part(lot, u, 1.0 - rng.between(0.16, 0.26), v, 1.0 - rng.between(0.2, 0.34));
    const double height_m = rng.between(4.2, 7.8);
    if (rng.unit() < 0.3) {
        append_corner(house, height_m, town);
    } else {
        append(house, height_m, town);
    }
}

void append_gardens(const Block& block, double edge, lod::Rng& rng, const Builder& town) {
    const int across = std::max(2, static_cast<int>(width_of(block) / 23.0));
    for (int row = 0; row < 2; ++row) {
        for (int col = 0; col < across; ++col) {
            const bool is_left_free = rng.unit() < 0.1 + 0.5 * edge;
            const double step = 1.0 / across;
            const Block lot = part(block, col * step, (col + 1) * step, 0.5 * row, 0.5 * (row + 1));
            if (!is_left_free) append_house(lot, rng, town);
        }
    }
}

/// Nave, choir and tower in the middle of the square.
void append_church(const Block& square, const Builder& town) {
    const glm::dvec2 middle = at(square, 0.5, 0.5);
    const glm::dvec2 along = glm::normalize(square[1] - square[0]), left(-along.y, along.x);
    const auto box = [&](double from, double to, double half) {
        return Block{middle + from * along - half * left, middle + to * along - half * left,
                     middle + to * along + half * left, middle + from * along + half * left};
    };
    append(box(-24.0, -15.0, 4.5), 41.0, town);
    append(box(-15.0, 14.0, 7.5), 17.0, town);
    append(box(14.0, 23.0, 5.0), 13.0, town);
}

/// A hall and its yard at the edge of the town.
void append_works(const Block& block, lod::Rng& rng, const Builder& town) {
    append(part(block, 0.08, 0.62, 0.15, 0.85), rng.between(8.0, 11.0), town);
    append(part(block, 0.72, 0.92, 0.2, 0.55), rng.between(5.0, 7.0), town);
}

void append_block(const Block& block, double share, lod::Rng& rng, const Builder& town) {
    const double kind = rng.unit();
    if (share < kCentreShare) {
        const double low = 19.0 - 14.0 * share, high = 33.0 - 34.0 * share;
        if (kind < 0.45) {
            append_courtyard(block, rng.between(low * 0.8, high * 0.8), rng, town);
        } else {
            append_terraces(block, low * 0.75, high, rng, town);
        }
    } else if (share < kTerraceShare) {
        if (kind < 0.06) {
            append_courtyard(block, rng.between(10.0, 13.0), rng, town);
        } else {
            append_terraces(block, 6.5, 12.5, rng, town);
        }
    } else if (kind < 0.07) {
        append_works(block, rng, town);
    } else {
        append_gardens(block, (share - kTerraceShare) / (1.0 - kTerraceShare), rng, town);
    }
}

/// A block of the plan: which one, its corners in the middle of the streets, how far out it lies.
struct Plot {
    int col = 0, row = 0;
    Block streets;
    double share = 0.0;  ///< of the radius
};

/// Calls `build(plot, rng)` for every block inside the town; the generator is the block's own.
template <typename Build>
void for_each_plot(const TownOptions& options, const Build& build) {
    const int reach = static_cast<int>(options.radius_m / kBlockNorthM) + 2;
    const uint64_t seed = options.seed;
    for (int row = -reach; row < reach; ++row) {
        for (int col = -reach; col < reach; ++col) {
            Plot plot{col,
                      row,
                      {crossing(col, row, seed), crossing(col + 1, row, seed),
                       crossing(col + 1, row + 1, seed), crossing(col, row + 1, seed)}};
            plot.share = glm::length(at(inset(plot.streets, options.street_width_m / 2.0), 0.5, 0.5)) /
                         options.radius_m;
            lod::Rng rng(lod::hash_combine(seed + 1, static_cast<uint64_t>((row + 500) * 1000 + col + 500)));
            if (plot.share + rng.between(-0.06, 0.06) <= 1.0) build(plot, rng);
        }
    }
}

}  // namespace

std::vector<TownBuilding> generate_town(const TownOptions& options) {
    std::vector<TownBuilding> buildings;
    const Builder town{options, buildings};
    for_each_plot(options, [&](const Plot& plot, lod::Rng& rng) {
        const Block block = inset(plot.streets, options.street_width_m / 2.0);
        if (plot.row == 0 && plot.col == 0) {
            append_church(block, town);
        } else {
            append_block(block, plot.share, rng, town);
        }
    });
    return buildings;
}

std::vector<TownStreet> generate_streets(const TownOptions& options) {
    std::set<std::array<int, 3>> sides;  // column, row, 0: eastwards from that crossing, 1: northwards
    for_each_plot(options, [&](const Plot& plot, lod::Rng&) {
        const auto [col, row] = std::pair(plot.col, plot.row);
        sides.insert({{col, row, 0}, {col, row + 1, 0}, {col, row, 1}, {col + 1, row, 1}});
    });
    std::vector<TownStreet> streets;
    for (const auto& [col, row, is_northwards] : sides) {
        streets.push_back({crossing(col, row, options.seed),
                           crossing(col + 1 - is_northwards, row + is_northwards, options.seed)});
    }
    return streets;
}

}  // namespace data
