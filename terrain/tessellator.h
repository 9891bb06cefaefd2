// Tessellator: the front's leaf triangles as vertices and indices of the geometry pool, in Sierpinski order.
//
// Every split diamond owns one vertex; its slot in the pool is its record's index, so a vertex is written once,
// when its diamond is split, and stays. Indices are walked anew for every view, depth first through the bintree:
// neighbours in the list share vertices, and subtrees the view cannot see are left out whole.
#pragma once

#include <span>
#include <vector>

#include "lod/draw_list.h"
#include "lod/view.h"
#include "terrain/diamond_bound.h"
#include "terrain/diamond_mesh.h"
#include "terrain/diamond_rank.h"
#include "terrain/vertex_glides.h"

namespace terrain {

/// What the walk reads; all of it belongs to the front.
struct TessellationInput {
    const DiamondTable& table;
    const DiamondMesh& mesh;
    std::span<const DiamondRank> ranks;  ///< [record]
    const BoundMaker& bound_of;
    const VertexGlides& glides;  ///< where vertices under way are
};

class Tessellator {
  public:
    /// A diamond has been split: its vertex must be written.
    void add_vertex(DiamondIndex index);
    /// The mesh begins anew: nothing announced so far matters.
    void forget_vertices();

    /// Sizes that hold `triangles` leaf triangles and `records` vertices.
    static lod::PoolRegion need(uint64_t triangles, uint32_t records);
    void place(const lod::PoolRegion& region);
    const lod::PoolRegion& region() const { return region_; }

    /// Call before the first emit of a frame.
    void begin_frame() { is_first_view_ = true; }

    /// Walks the mesh for one view. Allocates nothing once warm.
    void emit(const TessellationInput& input, const lod::View& view, lod::DrawList& out);

    uint64_t emitted_triangles() const { return emitted_; }

  private:
    bool refresh_page(const TessellationInput& input, uint32_t page);
    void write_vertices(const TessellationInput& input, lod::DrawList& out);

    lod::PoolRegion region_;
    std::vector<lod::Vertex> vertices_;  ///< [record]; the pool's twin
    std::vector<uint64_t> fresh_;        ///< a bit per record: split since its vertex was last written
    bool is_all_stale_ = true;           ///< the region is new: everything must be written
    std::vector<uint32_t> indices_;      ///< this frame's, all views
    bool is_first_view_ = true;
    uint64_t emitted_ = 0;
};

}  // namespace terrain
