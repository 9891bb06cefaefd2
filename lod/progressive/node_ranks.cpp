#include "lod/progressive/node_ranks.h"

#include <algorithm>
#include <limits>
#include <string>

#include "lod/base/check.h"
#include "lod/progressive/silhouette.h"

namespace lod {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();
constexpr uint32_t kNone = BucketQueue::kNone;
/// Instruments are looked at from about here, in their own unit.
constexpr double kTypicalDistance_m = 1.0;

}  // namespace

NodeRanks::NodeRanks(const ProgressiveMesh& mesh, const RankOptions& options)
    : mesh_(&mesh),
      silhouette_weight_(static_cast<float>(options.silhouette_weight)),
      odometer_(kTypicalDistance_m) {
    CHECK(options.silhouette_weight >= 1.0);
    scale_.reference_px = options.tolerance_px > 0.0 ? static_cast<float>(options.tolerance_px) : 1.0f;
    const size_t count = mesh.bounds.size(), blocks = (count + kBlock - 1) / kBlock;
    ranks_.resize(count);
    wake_m_.assign(count, kNever);
    wake_rad_.assign(count, kNever);
    earliest_m_.assign(blocks, kNever);
    earliest_rad_.assign(blocks, kNever);
    blocked_head_.assign(count, kNone);
    blocked_by_.assign(count, kNone);
    due_.reserve(count);
}

/// Always four lanes: one too many costs less than a branch that nobody can foresee.
FourEvaluations NodeRanks::evaluate_some(std::span<const uint32_t> some, Int4 watches_fall) const {
    FourBounds bounds;
    FourCones cones;
    for (size_t lane = 0; lane < 4; ++lane) {
        const NodeBound& bound = mesh_->bounds[some[lane < some.size() ? lane : 0]];
        bounds.set(static_cast<int>(lane), {bound.centre, bound.radius_m, bound.error_m});
        cones.set(static_cast<int>(lane), bound);
    }
    if (silhouette_weight_ == 1.0f) return evaluate(bounds, eyes(), scale_, watches_fall);
    const FourSilhouettes edge = silhouettes(bounds, cones, eyes());
    bounds.error_m = edge.is_silhouette ? bounds.error_m * silhouette_weight_ : bounds.error_m;
    FourEvaluations now = evaluate(bounds, eyes(), scale_, watches_fall);
    const Int4 is_fixed =
        edge.is_silhouette | (bounds.error_m == 0.0f) | (now.bucket == int32_t(kHiddenBucket));
    now.guard_m = is_fixed ? now.guard_m : min(now.guard_m, edge.guard_m);
    return now;
}

void NodeRanks::set_alarm(uint32_t record, float walk_m, float turn_rad) {
    wake_m_[record] = walk_m;
    wake_rad_[record] = turn_rad;
    const uint32_t block = record / kBlock;
    earliest_m_[block] = std::min(earliest_m_[block], walk_m);
    earliest_rad_[block] = std::min(earliest_rad_[block], turn_rad);
}

void NodeRanks::take(std::span<const uint32_t> some, Int4 watches_fall) {
    evaluations_ += some.size();
    const FourEvaluations now = evaluate_some(some, watches_fall);
    Float4 walk_m, turn_rad;
    odometer_.alarms(now, walk_m, turn_rad);
    for (size_t lane = 0; lane < some.size(); ++lane) {
        Rank& rank = ranks_[some[lane]];
        rank.bucket = static_cast<Bucket>(now.bucket[lane]);
        rank.stamp = stamp_;
        set_alarm(some[lane], walk_m[lane], turn_rad[lane]);
    }
}

void NodeRanks::rank(std::span<const uint32_t> some, bool watches_fall) {
    if (std::all_of(some.begin(), some.end(), [this](uint32_t record) { return holds(record); })) return;
    take(some, Int4{} - (watches_fall ? 1 : 0));
}

void NodeRanks::refresh(std::span<const uint32_t> some) {
    std::array<Bucket, 4> before{};
    Int4 watches_fall{};
    for (size_t lane = 0; lane < some.size(); ++lane) {
        before[lane] = bucket(some[lane]);
        watches_fall[lane] = queue(some[lane]) != NodeQueue::kSplit ? -1 : 0;
    }
    if (!some.empty()) take(some, watches_fall);
    for (size_t lane = 0; lane < some.size(); ++lane) {
        const uint32_t record = some[lane];
        if (bucket(record) == before[lane] || queue(record) == NodeQueue::kBlocked) continue;
        queue_at(queue(record)).remove(ranks_, record, before[lane]);
        queue_at(queue(record)).push(ranks_, record, bucket(record));
    }
}

void NodeRanks::refresh_head(NodeQueue queue, Bucket bucket) {
    std::array<uint32_t, 4> some{};
    size_t count = 0;
    uint32_t record = queue_at(queue).head(bucket);
    do {
        some[count++] = record;
        record = ranks_[record].link.next;
    } while (count < some.size() && record != kNone && !is_fresh(record));
    refresh({some.data(), count});
}

void NodeRanks::enqueue(uint32_t record, NodeQueue queue) {
    DCHECK(this->queue(record) == NodeQueue::kNone && queue != NodeQueue::kBlocked);
    ranks_[record].queue = static_cast<uint8_t>(queue);
    queue_at(queue).push(ranks_, record, bucket(record));
    ++queued_count_;
}

void NodeRanks::unlink(uint32_t record) {
    if (queue(record) == NodeQueue::kNone) return;
    if (queue(record) == NodeQueue::kBlocked) {
        const BucketLink link = ranks_[record].link;
        if (link.next != kNone) ranks_[link.next].link.previous = link.previous;
        if (link.previous != kNone) {
            ranks_[link.previous].link.next = link.next;
        } else {
            blocked_head_[blocked_by_[record]] = link.next;
        }
        blocked_by_[record] = kNone;
    } else {
        queue_at(queue(record)).remove(ranks_, record, bucket(record));
    }
    ranks_[record].queue = static_cast<uint8_t>(NodeQueue::kNone);
    --queued_count_;
}

void NodeRanks::block(uint32_t record, uint32_t by) {
    unlink(record);
    const uint32_t head = blocked_head_[by];
    ranks_[record].link = {kNone, head};
    if (head != kNone) ranks_[head].link.previous = record;
    blocked_head_[by] = record;
    blocked_by_[record] = by;
    ranks_[record].queue = static_cast<uint8_t>(NodeQueue::kBlocked);
    ++queued_count_;
}

void NodeRanks::release_blocked_by(uint32_t by) {
    while (blocked_head_[by] != kNone) {
        const uint32_t record = blocked_head_[by];
        unlink(record);
        enqueue(record, NodeQueue::kMerge);
    }
}

/// After the odometers began again. What sleeps keeps the rest of its guard; under other optics it wakes.
void NodeRanks::rewind_alarms(bool holds) {
    for (uint32_t record = 0; record < ranks_.size(); ++record) {
        if (wake_m_[record] == kNever) continue;
        const double walked = odometer_.walked_before_m() + 1e-6,
                     turned = odometer_.turned_before_rad() + 1e-7;
        set_alarm(record, holds ? static_cast<float>(double(wake_m_[record]) - walked) : -1.0f,
                  holds ? static_cast<float>(double(wake_rad_[record]) - turned) : -1.0f);
    }
}

void NodeRanks::collect_block(uint32_t block) {
    const float walked = odometer_.walked_m(), turned = odometer_.turned_rad();
    const uint32_t end = std::min(static_cast<uint32_t>(ranks_.size()), (block + 1) * kBlock);
    earliest_m_[block] = earliest_rad_[block] = kNever;
    for (uint32_t record = block * kBlock; record < end; ++record) {
        if (wake_m_[record] >= walked && wake_rad_[record] >= turned) {
            set_alarm(record, wake_m_[record], wake_rad_[record]);
        } else if (queue(record) != NodeQueue::kNone) {
            due_.push_back(record);
        } else {
            wake_m_[record] = wake_rad_[record] = kNever;
        }
    }
}

void NodeRanks::collect_due() {
    due_.clear();
    const float walked = odometer_.walked_m(), turned = odometer_.turned_rad();
    for (uint32_t block = 0; block < earliest_m_.size(); ++block) {
        if (earliest_m_[block] < walked || earliest_rad_[block] < turned) collect_block(block);
    }
}

EyeOdometer::Step NodeRanks::begin_frame(std::span<const View> views_body) {
    const EyeOdometer::Step step = odometer_.advance(views_body, glm::dvec3(0.0));
    if (step != EyeOdometer::Step::kAdvanced) rewind_alarms(step == EyeOdometer::Step::kRewound);
    ++stamp_;
    collect_due();
    return step;
}

std::string NodeRanks::validate() const {
    uint32_t linked = 0;
    for (uint32_t record = 0; record < ranks_.size(); ++record) {
        if (queue(record) == NodeQueue::kNone) continue;
        const std::string name = "node " + std::to_string(mesh_->leaf_count() + record);
        const FourEvaluations now = evaluate_some({&record, 1}, Int4{});
        if (!eyes().empty() && now.error_px[0] > scale_.upper_px(bucket(record)))
            return name + " is worse than its bucket says";
        const float earliest = earliest_m_[record / kBlock];
        if (wake_m_[record] < earliest || wake_rad_[record] < earliest_rad_[record / kBlock])
            return name + " would oversleep";
    }
    for (const NodeQueue which : {NodeQueue::kSplit, NodeQueue::kMerge, NodeQueue::kLeave}) {
        for (uint32_t b = 0; b < kBucketCount; ++b) {
            for (uint32_t i = queue_at(which).head(static_cast<Bucket>(b)); i != kNone;
                 i = ranks_[i].link.next) {
                if (bucket(i) != b || queue(i) != which)
                    return "record " + std::to_string(i) + " hangs wrong";
                if (++linked > queued_count_) return "a queue has a loop";
            }
        }
    }
    for (uint32_t by = 0; by < blocked_head_.size(); ++by) {
        for (uint32_t i = blocked_head_[by]; i != kNone; i = ranks_[i].link.next) {
            if (blocked_by_[i] != by) return "record " + std::to_string(i) + " waits for another";
            if (++linked > queued_count_) return "a list of the blocked has a loop";
        }
    }
    return linked == queued_count_ ? "" : "a queue has lost a record";
}

}  // namespace lod
