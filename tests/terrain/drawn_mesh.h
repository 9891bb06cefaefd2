// The triangles that are drawn, under the names the terrain tests use.
#pragma once

#include <algorithm>

#include "terrain/drawn/drawn_mesh.h"

namespace terrain_test {

using terrain::drawn_triangles;
using terrain::DrawnTriangle;
using terrain::emit_triangles;
using terrain::PoolTwin;

/// Calls visit(x, y, point) for every sample a triangle covers, its sides included, with the point of the drawn surface
/// above or below it, world.
template <typename Visit>
void for_each_sample(const DrawnTriangle& t, const Visit& visit) {
    const auto [a, b, c] = t.samples;
    const double area = double(b.x - a.x) * (c.y - a.y) - double(c.x - a.x) * (b.y - a.y);
    for (int y = std::min({a.y, b.y, c.y}); y <= std::max({a.y, b.y, c.y}); ++y) {
        for (int x = std::min({a.x, b.x, c.x}); x <= std::max({a.x, b.x, c.x}); ++x) {
            const double u = (double(x - a.x) * (c.y - a.y) - double(c.x - a.x) * (y - a.y)) / area;
            const double v = (double(b.x - a.x) * (y - a.y) - double(x - a.x) * (b.y - a.y)) / area;
            if (u >= 0.0 && v >= 0.0 && u + v <= 1.0)
                visit(x, y, t.world[0] + u * (t.world[1] - t.world[0]) + v * (t.world[2] - t.world[0]));
        }
    }
}

}  // namespace terrain_test
