// MeshSheet: the triangles of one body's cut in its part of the geometry pool, rewritten only where they changed.
//
//     indices   [ slot 0 | slot 1 | … ........ free ]   one draw item
//     vertices  [ vertex 0 | vertex 1 | … ]             a drawn vertex's id is its place
//
// A triangle keeps its slot while it is drawn; where one goes, the last takes the slot. A vertex is written when it is
// first drawn and stays; only while its node glides it is written every frame.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "lod/draw_list.h"
#include "lod/progressive/mesh_cut.h"
#include "lod/progressive/node_glides.h"

namespace lod {

/// What a frame writes, of all bodies; spans are taken when no more is added.
struct StagedWrites {
    struct Run {
        uint32_t first = 0, begin = 0, count = 0;  ///< place in the pool; begin and count in the vector below
    };
    std::vector<Vertex> vertices;
    std::vector<uint32_t> indices;
    std::vector<Run> vertex_runs, index_runs;

    void clear();
    void append_to(DrawList& out) const;
};

class MeshSheet {
  public:
    explicit MeshSheet(const ProgressiveMesh& mesh);

    /// Room that holds whatever the cut may become.
    static PoolRegion need(const ProgressiveMesh& mesh);
    /// Everything is written anew.
    void place(const PoolRegion& region);

    /// Takes what the cut touched; stages what changed since the last call. Cost: follows the change.
    /// @param strayed  vertices that were last drawn off their places and do not glide any more
    void update(MeshCut& cut, const NodeGlides& glides, std::span<const NodeId> strayed, StagedWrites& out);

    /// Its one item, or none.
    void emit(uint32_t instance, std::vector<DrawItem>& out) const;

    /// Compares the slots with the cut; the cut must have no untold change. Empty, or one line.
    std::string validate(const MeshCut& cut) const;

  private:
    static constexpr uint32_t kNoSlot = UINT32_MAX;
    static constexpr uint32_t kPage = 32;  ///< triangles written together, 384 bytes

    void mark(uint32_t slot) { dirty_[slot / kPage / 64] |= uint64_t{1} << (slot / kPage % 64); }
    void take(const MeshCut& cut, uint32_t triangle);
    void want_vertex(VertexId vertex) {
        if (is_written_[vertex]) return;
        is_written_[vertex] = 1;
        fresh_.push_back(vertex);
    }
    void recall(NodeId node, bool is_active);
    void stage_vertex(VertexId vertex, const glm::vec3& displacement_m, StagedWrites& out);
    void stage_pages(const MeshCut& cut, StagedWrites& out);

    const ProgressiveMesh* mesh_;
    PoolRegion region_;
    std::vector<uint32_t> slot_of_;      ///< [triangles]
    std::vector<uint32_t> triangle_of_;  ///< [slots in use]
    std::vector<uint64_t> dirty_;        ///< a bit per page
    std::vector<uint8_t> is_written_;    ///< [vertices]
    std::vector<VertexId> fresh_;        ///< to be written with this update
};

}  // namespace lod
