// RoamFront: the ROAM terrain behind lod::Front: split, forced split, merge and enhMerge on the bintree of one
// height grid, steered by two priority queues.
//
//     DiamondMesh   which diamonds are split            (diamond_mesh.h, topology)
//     DiamondTable  how wrong each may be, in metres    (diamond_table.h, computed once)
//     evaluate      the same in pixels, and for how long (lod/sight_metric.h)
//     BucketQueue   worst candidate, cheapest merge      (lod/bucket_queue.h)
//     Tessellator   the triangles, in Sierpinski order   (tessellator.h)
//
// Sources: Duchaineau et al., ROAMing Terrain (1997): dual queues. Elykov, Lavrentiev et al. (Softlab-NSK), section
// 5.2: enhMerge, which takes a split triangle back with everything below it, neighbours included, in one
// operation. Differs from both: priorities are re-evaluated lazily, bounded by the eye's motion.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "lod/bucket_queue.h"
#include "lod/eye_odometer.h"
#include "lod/front.h"
#include "lod/sight_metric.h"
#include "terrain/diamond_mesh.h"
#include "terrain/diamond_rank.h"
#include "terrain/diamond_table.h"
#include "terrain/record_bits.h"
#include "terrain/store/page_loader.h"
#include "terrain/table_edit.h"
#include "terrain/tessellator.h"
#include "terrain/unasked_diamonds.h"
#include "terrain/vertex_glides.h"

namespace terrain {

using lod::AnchoredEye;
using lod::Bucket;
using lod::BucketQueue;
using lod::BucketScale;
using lod::EyeOdometer;
using lod::FourBounds;
using lod::FourEvaluations;
using lod::kBucketCount;
using lod::kFirstErrorBucket;
using lod::kFlatBucket;
using lod::kHiddenBucket;

struct RoamOptions {
    double tolerance_px =
        1.0;               ///< the tolerance the scheduler will ask for: queue buckets have an edge there
    unsigned threads = 2;  ///< for the error computation; the result does not depend on it
    uint64_t reserve_triangles = 0;  ///< no operation allocates below this many
    bool is_pruning =
        true;              ///< enhMerge: take whole subtrees back; false: one merge at a time, for comparison
    double glide_s = 0.0;  ///< time a vertex takes to its place and back; 0: it jumps
    /// k in 0 … kMostBatch: each leaf of the mesh is drawn as 4^k triangles (batched_errors.h). Only for tables that are
    /// whole, and without gliding: what a split adds to a patch is no single vertex on an edge.
    int batch = 0;
};

/// What an edit took.
struct FrontEditCounts {
    TableEditCounts table;
    uint64_t records = 0;      ///< of the mesh, looked at
    uint64_t vertices = 0;     ///< moved
    uint64_t evaluations = 0;  ///< of candidates and diamonds that could be merged
};

class RoamFront final : public lod::Front {
  public:
    /// @param loader  brings the table's pages while the front runs; null: all of them are there
    RoamFront(DiamondTable table, const RoamOptions& options, std::unique_ptr<PageLoader> loader = nullptr);

    void begin_frame(std::span<const lod::View> views, double time_s) override;
    double refine_error_px() override;
    double coarsen_error_px() override;
    lod::Step refine() override;
    lod::Step coarsen(double limit_px) override;
    /// Those on their way back are no longer counted.
    uint64_t triangles() const override {
        return ((mesh_.triangles() - idle_triangles_) << (2 * options_.batch)) - leaving_triangles_;
    }
    uint64_t leaving_triangles() const override { return leaving_triangles_; }
    double error_px() override;
    lod::OperationCounts operations() const override { return operations_; }
    uint64_t hash() const override { return mesh_.hash(); }
    lod::PoolRegion pool_need() const override;
    void place(const lod::PoolRegion& region) override;
    void emit(const lod::View& view, lod::DrawList& out) override;
    double jump_px() const override { return glided_px_ + popped_px_ + edited_px_; }
    uint64_t emitted_triangles() const override { return tessellator_.emitted_triangles(); }
    std::string validate() const override;

    /// Takes a change of the grid over, between two frames: the table, the places of vertices, what queues hold. The
    /// cut stays as it is, and so does hash(); error_px() is true at once. The next frame's jump_px() counts how far
    /// the edit moved vertices. For a second nothing glides there: new ground appears at once, as fine as the budget
    /// allows.
    /// CHECKs that the table is whole and leaves are no patches: pages of a store and batched errors are not edited.
    /// Cost: edit_table's, and O(records over the range + levels).
    FrontEditCounts edit(const GroundEdit& edit);

    /// Forgets everything: back to two triangles. What Duchaineau did for incoherent frames; for comparison.
    void reset();

    const DiamondMesh& mesh() const { return mesh_; }
    const DiamondTable& table() const { return table_; }
    /// Null when the table is whole.
    const PageLoader* loader() const { return loader_.get(); }
    /// Evaluations since construction: what lazy re-evaluation saves.
    uint64_t evaluations() const { return evaluations_; }
    /// Bytes of the front itself beyond the height grid and its errors, in use.
    uint64_t memory_bytes() const;

  private:
    /// kWait: a candidate whose children's page is absent. kLeave: gliding back, merged when it is there. kUnasked:
    /// a candidate that nobody has looked at yet.
    enum class Queue : uint8_t { kNone, kSplit, kMerge, kWait, kLeave, kUnasked };
    /// Alarm of what needs no new look, or of what nothing is said.
    static constexpr float kNever = std::numeric_limits<float>::infinity();

    Bucket bucket_of(DiamondIndex index) const { return static_cast<Bucket>(mesh_[index].bucket); }
    Queue queue_of(DiamondIndex index) const { return static_cast<Queue>(mesh_[index].queue); }
    static constexpr uint8_t kStampMask = 31;
    bool is_queued(DiamondIndex index) const { return queue_of(index) != Queue::kNone; }
    /// Evaluated in this very frame (or a multiple of 32 ago, which costs order, never a bound).
    bool is_fresh(DiamondIndex index) const { return mesh_[index].stamp == (stamp_ & kStampMask); }
    BucketQueue& queue_at(Queue queue) { return queues_[static_cast<size_t>(queue) - 1]; }
    BucketQueue& splits() { return queue_at(Queue::kSplit); }
    BucketQueue& merges() { return queue_at(Queue::kMerge); }
    BucketQueue& waits() { return queue_at(Queue::kWait); }

    void grow_arrays();
    DiamondBound bound(DiamondIndex index) const { return bound_of_(mesh_[index], ranks_[index].source); }
    FourEvaluations evaluate_some(std::span<const DiamondIndex> some, float reach) const;
    Bucket family_bucket(DiamondIndex index);
    void rank(std::span<const DiamondIndex> some);
    void enqueue(DiamondIndex index, Queue queue);
    void dequeue(DiamondIndex index);
    void unlink(DiamondIndex index);
    void refresh(std::span<const DiamondIndex> some);
    void announce(std::span<const DiamondIndex> candidates);
    void ask(uint32_t most);
    void ask_all() { ask(0); }
    void offer(DiamondIndex index, Queue queue);
    void fetch_ahead(DiamondIndex head) const;
    bool are_children_here(DiamondIndex index) const;
    bool make_chain(DiamondIndex head);
    uint32_t split_one(DiamondIndex index);
    void merge_one(DiamondIndex index);
    uint32_t merge_subtree(DiamondIndex top);
    bool is_family_within(DiamondIndex top, Bucket limit);
    DiamondIndex climb(DiamondIndex index, Bucket limit);
    void rewind_alarms(EyeOdometer::Step step);
    void collect_due();
    bool is_little_worth_keeping(Bucket limit) const;
    void prune(Bucket limit);
    void take_back_in_cut();
    bool is_leap() const;
    void recall_waiting();

    bool is_gliding(DiamondIndex index) const {
        return options_.glide_s > 0.0 && !is_cut_ && bucket_of(index) > kFlatBucket &&
               (fresh_ground_.empty() || !is_on_fresh_ground(index));
    }
    bool is_on_fresh_ground(DiamondIndex index) const;
    bool find_base(DiamondIndex index, GlideBase& base) const;
    bool start_glide(DiamondIndex index, bool leaves);
    glm::vec3 base_from_place_m(const GlideBase& base, DiamondIndex index) const;
    glm::vec3 shown_m(DiamondIndex index) const {
        return bound(index).centre + glides_.displacement_m(index, mesh_[index].level);
    }
    DiamondBound shown_bound(DiamondIndex index) const;
    double shift_px(DiamondIndex index, const glm::vec3& way_m) const;
    double shift_px(DiamondIndex index, const BintreeTriangle& triangle, const glm::vec3& way_m) const;
    void measure_steps();
    void measure_glides();
    bool glides_alone(const VertexGlide& glide) const;
    void measure_around(DiamondIndex index);
    double mesh_error_px() const;
    bool was_seen(DiamondIndex candidate) const;
    void let_come(DiamondIndex index, bool is_watched);
    void note_pop(DiamondIndex index);
    double diagonals_apart_px(DiamondIndex index, const GlideBase& base, const glm::vec3& vertex_m) const;
    void note_flip(const VertexGlide& glide);
    bool has_popped_kin(DiamondIndex index) const;
    void forget_pops();
    uint32_t parents_of(DiamondIndex index) const;
    bool is_idle(DiamondIndex index) const {
        return mesh_[index].level > table_.domain.finest_level() - 2 * options_.batch;
    }
    uint64_t triangles_of(DiamondIndex index) const;
    void note_change(DiamondIndex index, bool is_split);
    uint64_t most_triangles() const;
    uint32_t most_records() const;
    bool leave(DiamondIndex index);
    void stay(DiamondIndex index);
    void advance_glides(bool is_cut);

    void list_touched(const data::SampleRange& range, std::vector<DiamondIndex>& out);
    void take_facts(DiamondIndex index, const DiamondSource& now, FrontEditCounts& counts);
    void end_glides_over(const data::SampleRange& range);
    void measure_edit();

    DiamondTable table_;
    RoamOptions options_;
    BucketScale scale_;
    BoundMaker bound_of_;

    DiamondMesh mesh_;
    std::vector<DiamondRank> ranks_;        ///< [record]
    std::vector<float> wake_m_, wake_rad_;  ///< odometer readings at which to evaluate again
    std::array<BucketQueue, 4> queues_;     ///< kSplit, kMerge, kWait, kLeave
    UnaskedDiamonds unasked_;
    Bucket refined_ = lod::kBucketCount - 1;  ///< of the latest refinement of this frame

    EyeOdometer odometer_;
    uint8_t stamp_ = 0;
    std::vector<DiamondIndex> due_, chain_, stack_, merged_;
    RecordBits has_met_;  ///< all clear between uses

    std::unique_ptr<PageLoader> loader_;  ///< null: no page is ever absent
    VertexGlides glides_;
    double now_s_ = 0.0;
    bool is_cut_ = true;  ///< this frame has nothing in common with the last: nothing glides
    uint64_t idle_triangles_ =
        0;  ///< of the mesh, by splits that draw nothing new: patches end with the grid
    uint64_t leaving_triangles_ = 0;  ///< that go when what leaves has left
    double set_out_px_ = 0.0;         ///< error of what was split in this frame and is still drawn
    double unglided_px_ = 0.0;     ///< error of the mesh with every vertex at its place, as the frame began
    double glide_px_ = 0.0;        ///< … where vertices are under way, as shown; 0: none is
    double glided_px_ = 0.0;       ///< farthest any vertex has moved since the last frame
    double popped_px_ = 0.0;       ///< … the surface has jumped where vertices did not glide
    double edited_px_ = 0.0;       ///< … an edit has moved any vertex
    double most_popped_px_ = 0.0;  ///< the largest error of a diamond that did not
    RecordBits has_popped_;        ///< in this frame, in view, without a glide
    RecordBits has_come_unseen_;   ///< in this frame, where no eye looked in the last
    std::vector<DiamondIndex> back_;
    std::vector<const VertexGlide*> together_;  ///< whose neighbours glide, too; of measure_glides() alone
    struct MovedVertex {
        DiamondIndex index = kOutside;
        glm::vec3 way_m{0.0f};
    };
    std::vector<MovedVertex> moved_;  ///< by edits since the last frame
    struct FreshGround {
        data::SampleRange range;  ///< on the domain
        double since_s = 0.0;
    };
    std::vector<FreshGround> fresh_ground_;  ///< edited so lately that nothing glides there

    Tessellator tessellator_;
    lod::OperationCounts operations_;
    uint64_t evaluations_ = 0;
};

/// Computes the errors (about a second for 4097 x 4097 samples) and starts at the coarsest mesh.
std::unique_ptr<RoamFront> make_roam_front(const data::HeightGrid& grid, const RoamOptions& options);

}  // namespace terrain
