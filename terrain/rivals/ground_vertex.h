// Vertices of the ground for the rivals, and StaticVertices, which hands them to the pool once and then forgets.
#pragma once

#include <vector>

#include "data/height_grid.h"
#include "lod/draw_list.h"

namespace terrain {

/// The vertex of a sample, lowered by `drop_m` along the local vertical.
inline lod::Vertex ground_vertex(const data::HeightGrid& grid, int col, int row, double drop_m = 0.0) {
    lod::Vertex vertex;
    const glm::dvec3 world = grid.frame.world_from_sample(col, row, double(grid.at(col, row)) - drop_m);
    lod::split_hi_lo(world, vertex.position_hi, vertex.position_lo);
    vertex.surface[0] = static_cast<uint16_t>(col);
    vertex.surface[1] = static_cast<uint16_t>(row);
    vertex.colour[0] = vertex.colour[1] = vertex.colour[2] = 255;
    vertex.colour[3] = static_cast<uint8_t>(lod::Material::kGround);
    return vertex;
}

/// Vertices that never change: made for the first emit after a place, given back with the next frame's.
class StaticVertices {
  public:
    void place() { is_written_ = false; }

    /// Call with the first view of each frame. @param fill  callable (std::vector<lod::Vertex>&): appends all
    template <typename Fill>
    void write(uint32_t first_vertex, lod::DrawList& out, const Fill& fill) {
        std::vector<lod::Vertex>().swap(vertices_);
        if (is_written_) return;
        fill(vertices_);
        out.vertex_writes.push_back({first_vertex, vertices_});
        is_written_ = true;
    }

  private:
    std::vector<lod::Vertex> vertices_;
    bool is_written_ = false;
};

}  // namespace terrain
