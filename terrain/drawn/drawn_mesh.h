// The triangles a front has put into a draw list, as a GPU would read them out of its buffers. No GL.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "lod/front.h"
#include "terrain/diamond.h"

namespace terrain {

/// One triangle as drawn; counter-clockwise from above.
struct DrawnTriangle {
    std::array<glm::dvec3, 3> world;   ///< metres
    std::array<GridPoint, 3> samples;  ///< columns and rows that the vertices claim to lie on
};

/// The buffers that a renderer would hold: writes arrive frame by frame, what was not written stays.
struct PoolTwin {
    std::vector<lod::Vertex> vertices;
    std::vector<uint32_t> indices;

    void apply(const lod::DrawList& list) {
        for (const lod::VertexWrite& write : list.vertex_writes) {
            vertices.resize(std::max(vertices.size(), write.first_vertex + write.vertices.size()));
            std::copy(write.vertices.begin(), write.vertices.end(), vertices.begin() + write.first_vertex);
        }
        for (const lod::IndexWrite& write : list.index_writes) {
            indices.resize(std::max(indices.size(), write.first_index + write.indices.size()));
            std::copy(write.indices.begin(), write.indices.end(), indices.begin() + write.first_index);
        }
    }
};

/// Every triangle the items of one module draw; those that name a vertex twice draw nothing.
inline std::vector<DrawnTriangle> drawn_triangles(const PoolTwin& pool, const lod::DrawList& list,
                                                  lod::Module module) {
    std::vector<DrawnTriangle> out;
    for (const lod::DrawItem& item : list.items) {
        if (list.instances[item.instance].module != static_cast<uint32_t>(module)) continue;
        for (uint32_t corner = 0; corner + 2 < item.index_count; corner += 3) {
            const uint32_t* named = &pool.indices[item.first_index + corner];
            if (named[0] == named[1]) continue;
            DrawnTriangle& triangle = out.emplace_back();
            for (size_t i = 0; i < 3; ++i) {
                const int64_t index = int64_t{named[i]} + item.base_vertex;
                const lod::Vertex& vertex = pool.vertices[static_cast<size_t>(index)];
                triangle.world[i] = lod::position_of(vertex);
                const glm::ivec2 sample = lod::ground_sample(vertex);
                triangle.samples[i] = {sample.x, sample.y};
            }
        }
    }
    return out;
}

/// Emits a front once and reads what it draws.
inline std::vector<DrawnTriangle> emit_triangles(lod::Front& front, const lod::View& view, PoolTwin& pool) {
    front.place(front.pool_need());
    lod::DrawList list;
    front.emit(view, list);
    pool.apply(list);
    return drawn_triangles(pool, list, lod::Module::kTerrain);
}

}  // namespace terrain
