// MeshSheet: the triangles of one body's cut in its part of the geometry pool, rewritten only where they changed.
//
//     indices   [ opaque slots ........ free | glass slots .... free ]   one draw item each
//     vertices  [ node 0 | node 1 | … ]                                 the node's id is its place
//
// A triangle keeps its slot while it is drawn; where one goes, the last of its class takes the slot. A vertex is
// written when it is first drawn and stays; only while it glides it is written every frame.
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

    /// Up to two items, opaque before glass.
    void emit(uint32_t instance, std::vector<DrawItem>& out) const;

    /// Compares the slots with the cut; the cut must have no untold change. Empty, or one line.
    std::string validate(const MeshCut& cut) const;

  private:
    static constexpr uint32_t kNoSlot = UINT32_MAX;
    static constexpr uint32_t kPage = 32;  ///< triangles written together, 384 bytes

    struct Class {
        uint32_t first_triangle = 0;        ///< its first slot, in triangles from the region's first index
        std::vector<uint32_t> triangle_of;  ///< [slots in use]
        std::vector<uint64_t> dirty;        ///< a bit per page
    };
    Class& class_of(uint32_t triangle) { return classes_[mesh_->is_glass[triangle]]; }
    void mark(Class& of, uint32_t slot) { of.dirty[slot / kPage / 64] |= uint64_t{1} << (slot / kPage % 64); }
    void take(const MeshCut& cut, uint32_t triangle);
    void want_vertex(NodeId node) {
        if (is_written_[node]) return;
        is_written_[node] = 1;
        fresh_.push_back(node);
    }
    void stage_vertex(NodeId node, const glm::vec3& displacement_m, StagedWrites& out);
    void stage_pages(const MeshCut& cut, Class& of, StagedWrites& out);

    const ProgressiveMesh* mesh_;
    PoolRegion region_;
    std::vector<uint32_t> slot_of_;    ///< [triangles]
    std::array<Class, 2> classes_;     ///< opaque, glass
    std::vector<uint8_t> is_written_;  ///< [nodes]
    std::vector<NodeId> fresh_;        ///< to be written with this update
};

}  // namespace lod
