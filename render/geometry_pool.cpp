#include "render/geometry_pool.h"

#include <array>

namespace render {

namespace {

/// One triangle that contains the picture, -1 … 1.
constexpr std::array<std::array<float, 2>, 3> kSkyCorners{{{-1.0f, -1.0f}, {3.0f, -1.0f}, {-1.0f, 3.0f}}};

lod::DrawItem write_sky(GeometryPool& pool) {
    const size_t first_vertex = pool.vertices.size() - 3, first_index = pool.indices.size() - 3;
    std::array<lod::Vertex, 3> corners{};
    for (size_t i = 0; i < 3; ++i) {
        corners[i].position_hi[0] = kSkyCorners[i][0];
        corners[i].position_hi[1] = kSkyCorners[i][1];
        corners[i].colour[3] = static_cast<uint8_t>(lod::Material::kSky);
    }
    pool.vertices.write(first_vertex, corners);
    pool.indices.write(first_index, std::array<uint32_t, 3>{0, 1, 2});
    return {.index_count = 3,
            .first_index = static_cast<uint32_t>(first_index),
            .base_vertex = static_cast<int32_t>(first_vertex)};
}

}  // namespace

lod::Result<GeometryPool> make_geometry_pool(const PoolCapacity& capacity) {
    auto vertices = MappedArray<lod::Vertex>::create(size_t{capacity.vertices} + 3, "vertex");
    if (!vertices) return vertices.error();
    auto indices = MappedArray<uint32_t>::create(size_t{capacity.indices} + 3, "index");
    if (!indices) return indices.error();
    GeometryPool pool{std::move(*vertices), std::move(*indices), {}};
    pool.sky = write_sky(pool);
    return pool;
}

uint64_t place_writes(const lod::DrawList& list, GeometryPool& pool) {
    uint64_t bytes = 0;
    for (const lod::VertexWrite& write : list.vertex_writes) {
        CHECK(write.first_vertex + write.vertices.size() + 3 <= pool.vertices.size());
        bytes += pool.vertices.write(write.first_vertex, write.vertices);
    }
    for (const lod::IndexWrite& write : list.index_writes) {
        CHECK(write.first_index + write.indices.size() + 3 <= pool.indices.size());
        bytes += pool.indices.write(write.first_index, write.indices);
    }
    return bytes;
}

}  // namespace render
