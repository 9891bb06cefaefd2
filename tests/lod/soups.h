// Soups for tests: random, flat, with holes, collapsed.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "lod/base/rng.h"
#include "lod/surface/triangle.h"

namespace lod_test {

/// A soup that owns its arrays.
struct OwnedSoup {
    std::vector<glm::dvec3> points;
    std::vector<std::array<uint32_t, 3>> triangles;

    lod::Soup view() const { return {points, triangles}; }
};

inline glm::dvec3 random_point(lod::Rng& rng, double size_m) {
    return {rng.between(0.0, size_m), rng.between(0.0, size_m), rng.between(0.0, size_m)};
}

/// Triangles of about `edge_m` strewn in a cube of `size_m`; every tenth is collapsed to a segment, every tenth to a
/// point.
inline OwnedSoup random_soup(lod::Rng& rng, uint32_t count, double size_m, double edge_m) {
    OwnedSoup soup;
    for (uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 at = random_point(rng, size_m);
        const bool is_point = i % 10 == 3, is_segment = i % 10 == 7;
        soup.points.push_back(at);
        soup.points.push_back(is_point ? at : at + random_point(rng, edge_m));
        soup.points.push_back(is_point || is_segment ? soup.points.back() : at + random_point(rng, edge_m));
        soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return soup;
}

/// A bumpy square of cells * cells * 2 triangles; cells in `hole` (a block from hole_begin to hole_end both ways) are
/// left out.
inline OwnedSoup bumpy_square(uint32_t cells, double bump_m, uint32_t hole_begin, uint32_t hole_end) {
    OwnedSoup soup;
    lod::Rng rng(7);
    for (uint32_t y = 0; y <= cells; ++y) {
        for (uint32_t x = 0; x <= cells; ++x)
            soup.points.emplace_back(x, y, bump_m * rng.unit());
    }
    for (uint32_t y = 0; y < cells; ++y) {
        for (uint32_t x = 0; x < cells; ++x) {
            if (x >= hole_begin && x < hole_end && y >= hole_begin && y < hole_end) continue;
            const uint32_t at = y * (cells + 1) + x;
            soup.triangles.push_back({at, at + 1, at + cells + 2});
            soup.triangles.push_back({at, at + cells + 2, at + cells + 1});
        }
    }
    return soup;
}

}  // namespace lod_test
