// MeshBody: one body's own state: its cut through a shared mesh, its ranks, its vertices under way.
//
//     MeshCut     which nodes are active            (mesh_cut.h, topology)
//     NodeRanks   worst node, cheapest collapse     (node_ranks.h)
//     NodeGlides  vertices under way                (node_glides.h)
//     GlideError  what they are off                 (glide_error.h)
//
// A body that no view can see sleeps: nothing is evaluated, split or collapsed, and its triangles are not counted. When
// it is seen again it goes on with the cut it had.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "lod/front.h"
#include "lod/progressive/glide_error.h"
#include "lod/progressive/mesh_cut.h"
#include "lod/progressive/node_glides.h"
#include "lod/progressive/node_ranks.h"
#include "lod/progressive/size_policy.h"
#include "lod/progressive/ways.h"

namespace lod {

struct MeshOptions {
    RankOptions ranks;
    double glide_s = 0.0;  ///< time a vertex takes to its place; 0: it jumps
    DetailPolicy policy = DetailPolicy::kError;
};

class MeshBody {
  public:
    /// Starts at the coarsest mesh. Keeps a reference.
    MeshBody(const ProgressiveMesh& mesh, const MeshOptions& options);

    /// @param views_body  the views in the body's frame (view_from_body)
    void begin_frame(std::span<const View> views_body, double time_s);

    bool is_asleep() const { return is_asleep_; }
    /// As lod::Front has them.
    double refine_error_px();
    double coarsen_error_px();
    Step refine();
    Step coarsen(double limit_px);
    double error_px() const;
    double jump_px() const { return std::max(jump_px_, waiting_pops_.worst_px(ranks_.eyes())); }
    /// Of the cut, without those that go when what glides away has gone; 0 while asleep.
    uint64_t triangles() const { return is_asleep_ ? 0 : cut_.triangle_count() - leaving_triangles_; }
    uint64_t leaving_triangles() const { return is_asleep_ ? 0 : leaving_triangles_; }
    const OperationCounts& operations() const { return operations_; }
    std::string validate() const;

    MeshCut& cut() { return cut_; }
    const MeshCut& cut() const { return cut_; }
    const NodeRanks& ranks() const { return ranks_; }
    const NodeGlides& glides() const { return glides_; }
    /// Nodes that were last drawn off their place and do not glide any more; taken by the caller, then cleared.
    std::vector<NodeId>& strayed() { return strayed_; }

  private:
    static constexpr uint32_t kNoRecord = 0xffffffffu;

    NodeId node_of(uint32_t record) const { return mesh().leaf_count() + record; }
    uint32_t record_of(NodeId node) const { return mesh().collapse_of(node); }
    const ProgressiveMesh& mesh() const { return cut_.mesh(); }

    void settle();
    bool has_jumped(std::span<const View> views_body);
    void refresh_due();
    void advance_glides();
    void measure_glides();
    bool is_gliding(uint32_t record) const {
        return options_.glide_s > 0.0 && !is_cut_ && ranks_.bucket(record) > kFlatBucket;
    }
    float way_m(uint32_t record) const;
    double pop_px(uint32_t record) const;
    void note_pop(uint32_t record);
    void take_pops();
    void forget_pops();
    bool leave(uint32_t record);
    void stay(uint32_t record);
    bool has_left(uint32_t record) const;
    void drop_glide(NodeId node);
    void split_one(NodeId node);
    void merge_one(uint32_t record);
    void admit_children(NodeId node);
    void admit_parent(NodeId node);

    MeshOptions options_;
    MeshCut cut_;
    NodeRanks ranks_;
    NodeGlides glides_;
    GlideError glide_error_;
    std::vector<NodeId> strayed_, chain_;
    std::vector<uint32_t> back_;
    uint32_t ready_ = kNoRecord;    ///< its collapse is known to be legal in this cut
    std::vector<View> last_views_;  ///< in the body's frame
    double now_s_ = 0.0;
    bool is_asleep_ = true;
    bool is_cut_ = true;  ///< this frame has nothing in common with the last: nothing glides
    uint64_t leaving_triangles_ = 0;
    uint64_t wanted_triangles_ = 0;  ///< by the size policy
    double set_out_px_ = 0.0;        ///< error of what was split in this frame and is still drawn
    double glide_px_ = 0.0, jump_px_ = 0.0;
    FourWays waiting_pops_;  ///< not in jump_px_ yet
    int waiting_count_ = 0;
    OperationCounts operations_;
};

}  // namespace lod
