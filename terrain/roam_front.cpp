#include "terrain/roam_front.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lod/base/check.h"

namespace terrain {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();
/// Once this share of the mesh must be looked at again, the frame is incoherent.
constexpr size_t kIncoherentShare = 4;
/// Subtrees are worth taking back whole when their error is this many buckets (two octaves) below the limit.
constexpr int kClimbMargin = 16;
/// After a longer pause nobody remembers the last picture.
constexpr double kLongestFrame_s = 0.5;

}  // namespace

RoamFront::RoamFront(DiamondTable table, const RoamOptions& options, std::unique_ptr<PageLoader> loader)
    : table_(std::move(table)),
      options_(options),
      bound_of_(table_),
      mesh_(table_.domain),
      loader_(std::move(loader)),
      glides_(options.glide_s) {
    scale_.reference_px = options.tolerance_px > 0.0 ? static_cast<float>(options.tolerance_px) : 1.0f;
    reset();
}

void RoamFront::reset() {
    queues_ = {};
    glides_.clear();
    leaving_triangles_ = 0;
    mesh_.clear();
    mesh_.reserve(options_.reserve_triangles);
    grow_arrays();
    tessellator_.forget_vertices();
    for (DiamondIndex corner = 0; corner < kCornerCount; ++corner) {
        ranks_[corner].source = table_.corners[corner];
        wake_m_[corner] = wake_rad_[corner] = kNever;
        tessellator_.add_vertex(corner);
    }
    admit({&kRoot, 1});
}

/// Room for every record the mesh has; the arrays follow its capacity, so that this rarely does anything.
void RoamFront::grow_arrays() {
    const size_t count = mesh_.record_count();
    if (ranks_.size() >= count) return;
    const size_t size = std::max<size_t>({count, ranks_.size() * 2, options_.reserve_triangles * 5 / 4 + 64});
    ranks_.resize(size);
    wake_m_.resize(size, kNever);
    wake_rad_.resize(size, kNever);
    due_.reserve(size);
    merged_.reserve(size);
    stack_.reserve(256);
    chain_.reserve(256);
}

/// @param some   one to four
/// @param reach  how many radii around each count as its own
FourEvaluations RoamFront::evaluate_some(std::span<const DiamondIndex> some, float reach) const {
    FourBounds bounds;
    lod::Int4 watches_fall{};
    // Always four: a lane too many costs less than a branch that nobody can foresee.
    for (size_t lane = 0; lane < 4; ++lane) {
        const DiamondIndex index = some[lane < some.size() ? lane : 0];
        bounds.set(static_cast<int>(lane), bound(index));
        watches_fall[lane] = mesh_[index].is_split ? -1 : 0;
    }
    bounds.radius_m *= reach;
    return evaluate(bounds, odometer_.eyes(), scale_, watches_fall);
}

/// Evaluates at most four records and sets when they wake next.
void RoamFront::rank(std::span<const DiamondIndex> some) {
    evaluations_ += some.size();
    const FourEvaluations now = evaluate_some(some, 1.0f);
    lod::Float4 walk_m, turn_rad;
    odometer_.alarms(now, walk_m, turn_rad);
    for (size_t lane = 0; lane < some.size(); ++lane) {
        RankTag& tag = mesh_.tag(some[lane]);
        tag.bucket = static_cast<Bucket>(now.bucket[lane]);
        tag.stamp = stamp_ & kStampMask;
        wake_m_[some[lane]] = walk_m[lane];
        wake_rad_[some[lane]] = turn_rad[lane];
    }
}

void RoamFront::enqueue(DiamondIndex index, Queue queue) {
    DCHECK(queue_of(index) == Queue::kNone);
    mesh_.tag(index).queue = static_cast<uint8_t>(queue) & 7;
    queue_at(queue).push(ranks_, index, bucket_of(index));
}

void RoamFront::dequeue(DiamondIndex index) {
    if (!is_queued(index)) return;
    unlink(index);
    wake_m_[index] = wake_rad_[index] = kNever;
}

/// Out of its queue, but still awake at its time.
void RoamFront::unlink(DiamondIndex index) {
    queue_at(queue_of(index)).remove(ranks_, index, bucket_of(index));
    mesh_.tag(index).queue = static_cast<uint8_t>(Queue::kNone) & 7;
}

/// Evaluates at most four queued records anew and moves them to their buckets.
void RoamFront::refresh(std::span<const DiamondIndex> some) {
    std::array<Bucket, 4> before{};
    for (size_t i = 0; i < some.size(); ++i)
        before[i] = bucket_of(some[i]);
    rank(some);
    for (size_t i = 0; i < some.size(); ++i) {
        if (bucket_of(some[i]) == before[i]) continue;
        if (queue_of(some[i]) == Queue::kLeave && bucket_of(some[i]) > before[i]) {
            queue_at(Queue::kLeave).remove(ranks_, some[i], before[i]);
            mesh_.tag(some[i]).queue = static_cast<uint8_t>(Queue::kNone) & 7;
            stay(some[i]);
            enqueue(some[i], Queue::kMerge);
            continue;
        }
        BucketQueue& queue = queue_at(queue_of(some[i]));
        queue.remove(ranks_, some[i], before[i]);
        queue.push(ranks_, some[i], bucket_of(some[i]));
    }
}

/// At most four new candidates.
void RoamFront::admit(std::span<const DiamondIndex> candidates) {
    for (DiamondIndex index : candidates)
        ranks_[index].source = table_.at(mesh_[index].centre(), mesh_[index].level);
    rank(candidates);
    for (DiamondIndex index : candidates)
        enqueue(index, Queue::kSplit);
}

/// After the odometers began again. What sleeps keeps the rest of its guard; under other optics it wakes.
void RoamFront::rewind_alarms(EyeOdometer::Step step) {
    const bool holds = step == EyeOdometer::Step::kRewound;
    for (size_t i = 0; i < mesh_.record_count(); ++i) {
        if (wake_m_[i] == kNever) continue;
        wake_m_[i] =
            holds ? static_cast<float>(double(wake_m_[i]) - odometer_.walked_before_m() - 1e-3) : -1.0f;
        wake_rad_[i] =
            holds ? static_cast<float>(double(wake_rad_[i]) - odometer_.turned_before_rad() - 1e-7) : -1.0f;
    }
}

/// Every record whose guard this frame's motion may have used up.
void RoamFront::collect_due() {
    constexpr size_t kBlock = 64;
    due_.clear();
    const float walked = odometer_.walked_m(), turned = odometer_.turned_rad();
    const size_t count = mesh_.record_count();
    for (size_t begin = 0; begin < count; begin += kBlock) {
        const size_t end = std::min(count, begin + kBlock);
        int any = 0;
        for (size_t i = begin; i < end; ++i)
            any |= static_cast<int>(wake_m_[i] < walked) | static_cast<int>(wake_rad_[i] < turned);
        if (any == 0) continue;
        for (size_t i = begin; i < end; ++i) {
            if (wake_m_[i] < walked || wake_rad_[i] < turned) due_.push_back(static_cast<DiamondIndex>(i));
        }
    }
}

void RoamFront::begin_frame(std::span<const lod::View> views, double time_s) {
    CHECK(!views.empty());
    if (loader_ && loader_->exchange(views, time_s, table_) > 0) recall_waiting();
    const EyeOdometer::Step step = odometer_.advance(views, bound_of_.anchor_world());
    if (step != EyeOdometer::Step::kAdvanced) rewind_alarms(step);
    ++stamp_;
    tessellator_.begin_frame();
    collect_due();
    const bool is_incoherent = due_.size() > mesh_.live_count() / kIncoherentShare && due_.size() > 64;
    const double passed_s = time_s - std::exchange(now_s_, time_s);
    advance_glides(is_incoherent || step == EyeOdometer::Step::kIncomparable || passed_s < 0.0 ||
                   passed_s > kLongestFrame_s);
    if (options_.is_pruning && is_incoherent) take_back_incoherent();
    // Some may have gone with what was taken back.
    std::erase_if(due_,
                  [&](DiamondIndex index) { return index >= mesh_.record_count() || !is_queued(index); });
    for (size_t i = 0; i < due_.size(); i += 4)
        refresh(std::span(due_).subspan(i, std::min<size_t>(4, due_.size() - i)));
}

/// Pages have come: what waited is asked again.
void RoamFront::recall_waiting() {
    while (!waits().is_empty()) {
        const DiamondIndex index = waits().head(waits().highest());
        unlink(index);
        enqueue(index, Queue::kSplit);
    }
}

double RoamFront::refine_error_px() {
    while (!splits().is_empty()) {
        const Bucket bucket = splits().highest();
        if (bucket == kHiddenBucket) return 0.0;
        const DiamondIndex head = splits().head(bucket);
        if (!is_fresh(head)) {
            refresh({&head, 1});
            continue;
        }
        return bucket == kFlatBucket ? 1e-30 : double(scale_.upper_px(bucket));
    }
    return 0.0;
}

double RoamFront::coarsen_error_px() {
    while (!merges().is_empty()) {
        const Bucket bucket = merges().lowest();
        const DiamondIndex head = merges().head(bucket);
        if (!is_fresh(head)) {
            refresh({&head, 1});
            continue;
        }
        return bucket <= kFlatBucket ? 0.0 : double(scale_.lower_px(bucket));
    }
    return std::numeric_limits<double>::infinity();
}

/// What is under way is as wrong as its place is far, beyond what the mesh around it is.
double RoamFront::error_px() {
    double settled = 0.0;
    for (BucketQueue* queue : {&splits(), &waits()}) {
        if (!queue->is_empty()) settled = std::max(settled, double(scale_.upper_px(queue->highest())));
    }
    return settled + glide_px_;
}

/// Splits one candidate whose parents are split.
uint32_t RoamFront::split_one(DiamondIndex index) {
    const SplitOutcome outcome = mesh_.split(index);
    unlink(index);
    grow_arrays();
    tessellator_.add_vertex(index);
    if (!is_gliding(index) || !start_glide(index, false)) note_pop(index);
    for (uint32_t i = 0; i < outcome.no_longer_mergeable_count; ++i) {
        const DiamondIndex parent = outcome.no_longer_mergeable[i];
        if (queue_of(parent) == Queue::kLeave) stay(parent);
        dequeue(parent);
    }
    if (outcome.created_count > 0) admit({outcome.created.data(), outcome.created_count});
    // Its evaluation stands; that it does not watch for a fall yet only delays a merge until it next wakes.
    enqueue(index, Queue::kMerge);
    return 1;
}

/// Starts loading what the next two refinements are likely to touch: the mesh is larger than the caches, and
/// best first is a walk without locality.
void RoamFront::fetch_ahead(DiamondIndex head) const {
    const DiamondIndex next = ranks_[head].link.next;
    if (next == BucketQueue::kNone) return;
    const DiamondIndex later = ranks_[next].link.next;
    if (later != BucketQueue::kNone) {
        mesh_.fetch(later);
        __builtin_prefetch(&ranks_[later]);
    }
    mesh_.fetch_kin(next);
    const Diamond& d = mesh_[next];
    if (d.level >= table_.domain.finest_level()) return;
    for (int side = 0; side < 4; ++side) {
        const GridPoint child =
            step_from(d.centre(), d.apex_dir + 2 * side + 1, table_.domain.child_step(d.level));
        if (table_.domain.contains(child)) __builtin_prefetch(table_.find(child, d.level + 1));
    }
}

bool RoamFront::are_children_here(DiamondIndex index) const {
    const Diamond& d = mesh_[index];
    if (d.level >= table_.domain.finest_level()) return true;
    for (int side = 0; side < 4; ++side) {
        const GridPoint child =
            step_from(d.centre(), d.apex_dir + 2 * side + 1, table_.domain.child_step(d.level));
        if (table_.domain.contains(child) && table_.find(child, d.level + 1) == nullptr) return false;
    }
    return true;
}

/// The splits that one split needs, last first; false when a page for one of them is absent. A chain, not a tree:
/// a record has one parent that is split.
bool RoamFront::make_chain(DiamondIndex head) {
    chain_.assign(1, head);
    while (true) {
        if (loader_ && !are_children_here(chain_.back())) return false;
        const DiamondIndex missing = mesh_.missing_parent(chain_.back());
        if (missing == kOutside) return true;
        chain_.push_back(missing);
    }
}

lod::Step RoamFront::refine() {
    lod::Step step;
    const uint64_t before = triangles();
    while (refine_error_px() > 0.0) {
        const DiamondIndex head = splits().head(splits().highest());
        fetch_ahead(head);
        if (!make_chain(head)) {
            unlink(head);
            enqueue(head, Queue::kWait);
            continue;
        }
        while (!chain_.empty()) {
            step.steps += split_one(chain_.back());
            chain_.pop_back();
            ++operations_[chain_.empty() ? lod::OperationKind::kSplit : lod::OperationKind::kForcedSplit];
        }
        break;
    }
    step.triangle_delta = static_cast<int64_t>(triangles() - before);
    return step;
}

/// Merges one diamond without split children; its record becomes a candidate again.
void RoamFront::merge_one(DiamondIndex index) {
    unlink(index);
    glides_.drop(index, mesh_[index].level);
    const MergeOutcome outcome = mesh_.merge(index);
    for (uint32_t i = 0; i < outcome.removed_count; ++i)
        dequeue(outcome.removed[i]);
    for (uint32_t i = 0; i < outcome.mergeable_count; ++i) {
        rank_one(outcome.mergeable[i]);
        enqueue(outcome.mergeable[i], Queue::kMerge);
    }
    enqueue(index, Queue::kSplit);  // its evaluation watched for a rise, too
}

lod::Step RoamFront::coarsen(double limit_px) {
    lod::Step step;
    if (coarsen_error_px() > limit_px) return step;
    const uint64_t before = triangles();
    const Bucket bucket = merges().lowest();
    const DiamondIndex head = merges().head(bucket);
    const Bucket limit = limit_px > 0.0 ? scale_.bucket_of(static_cast<float>(limit_px)) : kFlatBucket;
    // What is seen glides back one by one; what is not may go as a whole.
    const bool is_far_below =
        bucket == kHiddenBucket || (bucket + kClimbMargin <= limit && !is_gliding(head));
    const DiamondIndex top = options_.is_pruning && is_far_below ? climb(head, limit) : head;
    if (top == head) {
        if (!leave(head)) {
            note_pop(head);
            merge_one(head);
        }
        step.steps = 1;
        ++operations_[lod::OperationKind::kMerge];
    } else {
        step.steps = merge_subtree(top);
        ++operations_[lod::OperationKind::kEnhMerge];
    }
    step.triangle_delta = static_cast<int64_t>(triangles()) - static_cast<int64_t>(before);
    return step;
}

lod::PoolRegion RoamFront::pool_need() const {
    const uint64_t triangles = std::max(mesh_.triangles(), options_.reserve_triangles);
    const uint64_t records =
        std::max<uint64_t>(mesh_.record_count(), options_.reserve_triangles * 5 / 4 + 64);
    return Tessellator::need(triangles, static_cast<uint32_t>(records));
}

void RoamFront::emit(const lod::View& view, lod::DrawList& out) {
    tessellator_.emit({table_, mesh_, ranks_, bound_of_, glides_}, view, out);
}

std::unique_ptr<RoamFront> make_roam_front(const data::HeightGrid& grid, const RoamOptions& options) {
    return std::make_unique<RoamFront>(make_diamond_table(grid, options.threads), options);
}

}  // namespace terrain
