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
    lod::set_ground_sample(vertex, col, row);
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
