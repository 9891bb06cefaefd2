// NodeRanks: which node of one body is worst and which collapse is cheapest, for as long as the proof holds.
//
// One record a collapse. Its node is active, its screen error a reason to split (kSplit); or its two children are, and
// the same error is the price of the collapse (kMerge), which may have to wait for another (kBlocked) or be under way
// (kLeave). Errors are counted where they are seen: a silhouette's by `silhouette_weight`.
//
// Buckets, odometers and guards are those of the terrain (bucket_queue.h, eye_odometer.h, sight_metric.h), in the
// body's own frame: what stands still relative to the eye costs nothing, a cockpit above all. Sleepers lie in blocks
// that know their earliest alarm.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "lod/bucket_queue.h"
#include "lod/eye_odometer.h"
#include "lod/progressive/mesh_tables.h"

namespace lod {

enum class NodeQueue : uint8_t { kNone, kSplit, kMerge, kBlocked, kLeave };

struct RankOptions {
    double tolerance_px = 1.0;       ///< buckets have an edge there
    double silhouette_weight = 2.0;  ///< >= 1; 1: silhouettes are as good as anything else
};

class NodeRanks {
  public:
    /// Keeps a reference.
    NodeRanks(const ProgressiveMesh& mesh, const RankOptions& options);

    /// Takes the frame's views, in the body's frame, and lists the records whose guard may be used up.
    EyeOdometer::Step begin_frame(std::span<const View> views_body);
    std::span<const uint32_t> due() const { return due_; }

    Bucket bucket(uint32_t record) const { return ranks_[record].bucket; }
    NodeQueue queue(uint32_t record) const { return static_cast<NodeQueue>(ranks_[record].queue); }
    /// The one behind it in its bucket; BucketQueue::kNone: none.
    uint32_t behind(uint32_t record) const { return ranks_[record].link.next; }
    /// Evaluated in this very frame.
    bool is_fresh(uint32_t record) const { return ranks_[record].stamp == stamp_; }
    const BucketScale& scale() const { return scale_; }
    std::span<const AnchoredEye> eyes() const { return odometer_.eyes(); }
    BucketQueue& queue_at(NodeQueue queue) { return queues_[static_cast<size_t>(queue)]; }
    const BucketQueue& queue_at(NodeQueue queue) const { return queues_[static_cast<size_t>(queue)]; }
    uint32_t queued_count() const { return queued_count_; }

    /// Evaluates one to four records that are out of their queues, unless all were and it still holds.
    void rank(std::span<const uint32_t> some, bool watches_fall);
    /// Evaluates none to four queued records again and moves them to their buckets.
    void refresh(std::span<const uint32_t> some);
    /// Refreshes the head of a bucket, and up to three behind it at the same cost.
    void refresh_head(NodeQueue queue, Bucket bucket);

    void enqueue(uint32_t record, NodeQueue queue);
    /// Without an evaluation yet: it is due with the next frame.
    void wake(uint32_t record) { set_alarm(record, -1.0f, -1.0f); }
    /// Out of its queue. What it was evaluated to holds until its alarm.
    void unlink(uint32_t record);

    /// From kMerge to kBlocked until the collapse `by` is done.
    void block(uint32_t record, uint32_t by);
    /// The collapse is done: what it blocked is asked again.
    void release_blocked_by(uint32_t by);

    /// Evaluations since construction: what laziness saves.
    uint64_t evaluations() const { return evaluations_; }

    /// Checks links, buckets and every sleeper's promise against a fresh look. Slow.
    std::string validate() const;

  private:
    struct Rank {
        BucketLink link;
        Bucket bucket = kHiddenBucket;
        uint8_t queue = 0;
        uint16_t stamp = 0;
    };
    static_assert(sizeof(Rank) == 12);
    static constexpr uint32_t kBlock = 64;

    FourEvaluations evaluate_some(std::span<const uint32_t> some, Int4 watches_fall) const;
    void take(std::span<const uint32_t> some, Int4 watches_fall);
    bool holds(uint32_t record) const {
        return wake_m_[record] < std::numeric_limits<float>::infinity() &&
               wake_m_[record] >= odometer_.walked_m() && wake_rad_[record] >= odometer_.turned_rad();
    }
    void set_alarm(uint32_t record, float walk_m, float turn_rad);
    void rewind_alarms(bool holds);
    void collect_due();
    void collect_block(uint32_t block);

    const ProgressiveMesh* mesh_;
    BucketScale scale_;
    float silhouette_weight_ = 1.0f;
    EyeOdometer odometer_;
    std::vector<Rank> ranks_;                          ///< [collapses]
    std::vector<float> wake_m_, wake_rad_;             ///< [collapses] readings at which to evaluate again
    std::vector<float> earliest_m_, earliest_rad_;     ///< [blocks] no record of the block wakes before
    std::array<BucketQueue, 5> queues_;                ///< by NodeQueue; kNone and kBlocked unused
    std::vector<uint32_t> blocked_head_, blocked_by_;  ///< [collapses] lists through the links
    std::vector<uint32_t> due_;
    uint16_t stamp_ = 0;
    uint32_t queued_count_ = 0;
    uint64_t evaluations_ = 0;
};

}  // namespace lod
