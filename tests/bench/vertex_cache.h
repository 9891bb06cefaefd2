// Vertex-cache reuse of an index list: a FIFO of so many vertices, as graphics processors had them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace bench {

/// Vertices fetched a triangle (ACMR): 3 without any reuse, about 0.5 at best. Triangles that name a vertex twice do not
/// count.
inline double fifo_misses_a_triangle(std::span<const uint32_t> indices, size_t size) {
    std::vector<uint32_t> cache(size, UINT32_MAX);
    size_t oldest = 0, misses = 0, triangles = 0;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        if (indices[i] == indices[i + 1]) continue;
        ++triangles;
        for (const uint32_t vertex : indices.subspan(i, 3)) {
            if (std::find(cache.begin(), cache.end(), vertex) != cache.end()) continue;
            cache[oldest] = vertex;
            oldest = (oldest + 1) % size;
            ++misses;
        }
    }
    return triangles == 0 ? 0.0 : double(misses) / double(triangles);
}

}  // namespace bench
