#include "lod/progressive/weld.h"

#include <bit>
#include <cmath>
#include <unordered_map>

#include "lod/base/hash.h"

namespace lod {
namespace {

struct Cell {
    int64_t x = 0, y = 0, z = 0;
    bool operator==(const Cell&) const = default;
};
struct CellHash {
    size_t operator()(const Cell& cell) const {
        uint64_t hash = hash_combine(0, static_cast<uint64_t>(cell.x));
        hash = hash_combine(hash, static_cast<uint64_t>(cell.y));
        return static_cast<size_t>(hash_combine(hash, static_cast<uint64_t>(cell.z)));
    }
};

Cell bits_of(const glm::vec3& p) {
    const glm::vec3 q = p + 0.0f;  // -0 becomes 0
    return {std::bit_cast<int32_t>(q.x), std::bit_cast<int32_t>(q.y), std::bit_cast<int32_t>(q.z)};
}

/// The cells of a grid of this size; far beyond what 64 bits hold, all share one.
Cell cell_of(const glm::vec3& p, double size) {
    const auto index = [size](float value) {
        const double cell = std::floor(double(value) / size);
        return std::abs(cell) < 9e15 ? static_cast<int64_t>(cell) : int64_t{9000000000000000};
    };
    return {index(p.x), index(p.y), index(p.z)};
}

using Grid = std::unordered_map<Cell, std::vector<uint32_t>, CellHash>;

/// The first of the places in the cells around `at` that is near enough, or `none`.
uint32_t find_near(const Grid& grid, std::span<const glm::vec3> places, const glm::vec3& at, double within) {
    const Cell middle = cell_of(at, within);
    auto best = static_cast<uint32_t>(places.size());
    for (int64_t i = 0; i < 27; ++i) {
        const auto cell = grid.find({middle.x + i % 3 - 1, middle.y + i / 3 % 3 - 1, middle.z + i / 9 - 1});
        if (cell == grid.end()) continue;
        for (uint32_t place : cell->second) {
            const glm::dvec3 apart = glm::dvec3(places[place]) - glm::dvec3(at);
            if (place < best && glm::dot(apart, apart) <= within * within) best = place;
        }
    }
    return best;
}

}  // namespace

std::vector<uint32_t> number_places(std::span<const glm::vec3> positions, double within) {
    std::vector<uint32_t> place_of(positions.size());
    if (!(within > 0.0)) {
        std::unordered_map<Cell, uint32_t, CellHash> number;
        number.reserve(positions.size());
        for (size_t i = 0; i < positions.size(); ++i) {
            const auto next = static_cast<uint32_t>(number.size());
            place_of[i] = number.emplace(bits_of(positions[i]), next).first->second;
        }
        return place_of;
    }
    Grid grid;
    std::vector<glm::vec3> places;
    for (size_t i = 0; i < positions.size(); ++i) {
        place_of[i] = find_near(grid, places, positions[i], within);
        if (place_of[i] != places.size()) continue;
        grid[cell_of(positions[i], within)].push_back(place_of[i]);
        places.push_back(positions[i]);
    }
    return place_of;
}

}  // namespace lod
