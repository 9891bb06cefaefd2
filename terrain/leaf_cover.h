// Which triangles cover anything: vertices beyond the raster are clamped to its border, which squeezes some to nothing.
#pragma once

#include "terrain/triangle_error.h"

namespace terrain {

/// Whether anything is left of a triangle within the raster.
inline bool covers_raster(const Domain& domain, const TriangleCorners& t) {
    if (domain.in_raster(t.apex) && domain.in_raster(t.left) && domain.in_raster(t.right)) return true;
    const GridPoint a = domain.clamped(t.apex), b = domain.clamped(t.left), c = domain.clamped(t.right);
    return int64_t(b.x - a.x) * (c.y - a.y) != int64_t(c.x - a.x) * (b.y - a.y);
}

}  // namespace terrain
