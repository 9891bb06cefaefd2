// Tessellator: the front's leaf triangles as vertices and indices of the geometry pool, in Sierpinski order.
//
// Every split diamond owns one vertex; its slot in the pool is its record's index, so a vertex is written once,
// when its diamond is split, and stays. Indices lie in runs (index_runs.h) and stay as well, until a split or a
// merge touches their run. A view draws the stretches of the list it may see.
//
// Leaves may be drawn as patches of 4^k triangles over the samples below (batched_errors.h). The samples they need beside
// the mesh's vertices have slots of their own, behind those of the records.
//
//     vertices   [ records ............ | patches' samples ............ ]
#pragma once

#include <span>
#include <vector>

#include "lod/draw_list.h"
#include "lod/view.h"
#include "terrain/diamond_bound.h"
#include "terrain/diamond_mesh.h"
#include "terrain/diamond_rank.h"
#include "terrain/index_runs.h"
#include "terrain/patch_vertices.h"
#include "terrain/vertex_glides.h"

namespace terrain {

/// What is drawn; all of it belongs to the front.
struct TessellationInput {
    const DiamondTable& table;
    const DiamondMesh& mesh;
    std::span<const DiamondRank> ranks;  ///< [record]
    const BoundMaker& bound_of;
    const VertexGlides& glides;  ///< where vertices under way are
};

class Tessellator {
  public:
    /// @param batch  k: leaves are drawn as 4^k triangles each where the grid is that fine
    explicit Tessellator(int batch) : batch_(batch) {}

    /// A vertex must be written: its diamond has been split, or it is shown elsewhere.
    void add_vertex(DiamondIndex index);
    /// The diamond with this centre has been split or merged.
    void change(GridPoint centre);
    /// The mesh begins anew: nothing announced so far matters.
    void forget();

    /// Sizes that hold so many triangles, patches' counted singly, and vertices of so many records; more than there is
    /// when either has outgrown its part.
    lod::PoolRegion need(uint64_t triangles, uint32_t records) const;
    /// @param records  of these many and these many triangles are the parts made; what is left over they share
    void place(const lod::PoolRegion& region, uint64_t triangles, uint32_t records);
    const lod::PoolRegion& region() const { return region_; }

    /// Call before the first emit of a frame.
    void begin_frame() { is_first_view_ = true; }

    /// Appends what one view sees. Allocates nothing once warm. Cost: with the first view of a frame as what has
    /// changed since the last, and with every view as the number of runs.
    void emit(const TessellationInput& input, const lod::View& view, lod::DrawList& out);

    uint64_t emitted_triangles() const { return emitted_; }

  private:
    lod::Vertex vertex_at(const TessellationInput& input, uint32_t slot) const;
    void refresh_page(const TessellationInput& input, uint32_t page, uint64_t bits);
    void write_vertices(const TessellationInput& input, lod::DrawList& out);
    void write_indices(const TessellationInput& input, lod::DrawList& out);
    void add_items(const TessellationInput& input, const lod::View& view, lod::DrawList& out);

    lod::PoolRegion region_;
    std::vector<lod::Vertex> vertices_;  ///< [slot]; the pool's twin
    std::vector<uint64_t> fresh_;        ///< a bit per slot: must be written
    bool is_all_stale_ = true;           ///< the region is new: everything must be written
    int batch_ = 0;
    uint32_t record_slots_ = 0;
    PatchVertices patches_;
    IndexRuns runs_;
    std::vector<IndexRange> stretches_;  ///< scratch: of the list, to be drawn
    bool is_first_view_ = true;
    uint64_t emitted_ = 0;
};

}  // namespace terrain
