#include "terrain/roam_front.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lod/base/check.h"
#include "terrain/batched_errors.h"

namespace terrain {
namespace {

/// Candidates that may wait to be asked: enough for their facts to arrive and for four lanes to be full.
constexpr uint32_t kUnaskedMost = 6;
/// Once this share of the mesh must be looked at again, the frame is incoherent.
constexpr size_t kIncoherentShare = 4;
/// Subtrees are worth taking back whole when their error is this many buckets (two octaves) below the limit.
constexpr int kClimbMargin = 16;
/// After a longer pause nobody remembers the last picture.
constexpr double kLongestFrame_s = 0.5;

/// Patches end where the grid does.
RoamOptions possible(const Domain& domain, RoamOptions options) {
    options.batch = std::min(options.batch, domain.log2_side);
    return options;
}

DiamondTable batched(DiamondTable table, const RoamOptions& options) {
    batch_errors(table, possible(table.domain, options).batch, options.threads);
    return table;
}

}  // namespace

RoamFront::RoamFront(DiamondTable table, const RoamOptions& options, std::unique_ptr<PageLoader> loader)
    : table_(batched(std::move(table), options)),
      options_(possible(table_.domain, options)),
      scale_(lod::scale_at(options.tolerance_px)),
      bound_of_(table_),
      mesh_(table_.domain),
      loader_(std::move(loader)),
      glides_(options_.glide_s),
      tessellator_(options_.batch) {
    CHECK(options_.batch == 0 || (!loader_ && options_.glide_s == 0.0));
    reset();
}

void RoamFront::reset() {
    queues_ = {};
    unasked_.clear();
    glides_.clear();
    idle_triangles_ = leaving_triangles_ = 0;
    mesh_.clear();
    mesh_.reserve(options_.reserve_triangles >> (2 * options_.batch));
    grow_arrays();
    tessellator_.forget();
    for (DiamondIndex corner = 0; corner < kCornerCount; ++corner) {
        ranks_[corner].source = table_.corners[corner];
        wake_m_[corner] = wake_rad_[corner] = kNever;
        tessellator_.add_vertex(corner);
    }
    announce({&kRoot, 1});
    ask_all();
}

/// Room for every record the mesh has; the arrays follow its capacity, so that this rarely does anything.
void RoamFront::grow_arrays() {
    const size_t count = mesh_.record_count();
    if (ranks_.size() >= count) return;
    const size_t size = std::max<size_t>({count, ranks_.size() * 2, most_records()});
    ranks_.resize(size);
    wake_m_.resize(size, kNever);
    wake_rad_.resize(size, kNever);
    due_.reserve(size);
    merged_.reserve(size);
    has_popped_.resize(size);
    has_come_unseen_.resize(size);
    has_met_.resize(size);
    stack_.reserve(256);
    chain_.reserve(256);
}

void RoamFront::begin_frame(std::span<const lod::View> views, double time_s) {
    CHECK(!views.empty());
    ask_all();
    refined_ = lod::kBucketCount - 1;
    if (loader_ && loader_->exchange(views, time_s, table_) > 0) recall_waiting();
    const EyeOdometer::Step step = odometer_.advance(views, bound_of_.anchor_world());
    if (step != EyeOdometer::Step::kAdvanced) rewind_alarms(step);
    ++stamp_;
    tessellator_.begin_frame();
    collect_due();
    const bool is_incoherent = due_.size() > mesh_.live_count() / kIncoherentShare && due_.size() > 64;
    const double passed_s = time_s - std::exchange(now_s_, time_s);
    measure_edit();
    advance_glides(step == EyeOdometer::Step::kIncomparable || passed_s < 0.0 || passed_s > kLongestFrame_s ||
                   (is_incoherent && is_leap()));
    if (options_.is_pruning && is_incoherent && is_cut_) take_back_in_cut();
    // Some may have gone with what was taken back.
    std::erase_if(due_,
                  [&](DiamondIndex index) { return index >= mesh_.record_count() || !is_queued(index); });
    for (size_t i = 0; i < due_.size(); i += 4)
        refresh(std::span(due_).subspan(i, std::min<size_t>(4, due_.size() - i)));
    measure_glides();
}

/// Pages have come: what waited is asked again.
void RoamFront::recall_waiting() {
    while (!waits().is_empty()) {
        const DiamondIndex index = waits().head(waits().highest());
        unlink(index);
        enqueue(index, Queue::kSplit);
    }
}

/// Of the candidates that have been asked. While they are no better than what was refined last, the few that have
/// not can wait: the order among those that are refined anyway is of no account.
double RoamFront::refine_error_px() {
    if (!unasked_.is_empty() && (splits().is_empty() || splits().highest() < refined_)) ask_all();
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

/// Of the mesh with every vertex at its place.
double RoamFront::mesh_error_px() const {
    double worst_px = 0.0;
    for (const Queue queue : {Queue::kSplit, Queue::kWait}) {
        const BucketQueue& candidates = queues_[static_cast<size_t>(queue) - 1];
        if (!candidates.is_empty())
            worst_px = std::max(worst_px, double(scale_.upper_px(candidates.highest())));
    }
    return worst_px;
}

/// Where vertices are under way, what the frame has added to the mesh's error counts in full, at most.
double RoamFront::error_px() {
    ask_all();
    const double mesh_px = mesh_error_px();
    return std::max({mesh_px, set_out_px_, glide_px_ + std::max(mesh_px - unglided_px_, 0.0)});
}

/// Splits one candidate whose parents are split.
uint32_t RoamFront::split_one(DiamondIndex index) {
    const bool is_watched = !is_cut_ && bucket_of(index) != kHiddenBucket && was_seen(index);
    const SplitOutcome outcome = mesh_.split(index);
    unlink(index);
    grow_arrays();
    tessellator_.add_vertex(index);
    note_change(index, true);
    let_come(index, is_watched);
    for (uint32_t i = 0; i < outcome.no_longer_mergeable_count; ++i) {
        const DiamondIndex parent = outcome.no_longer_mergeable[i];
        if (queue_of(parent) == Queue::kLeave) stay(parent);
        if (is_queued(parent)) unlink(parent);
    }
    announce({outcome.created.data(), outcome.created_count});
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
        if (queue_of(missing) == Queue::kUnasked) ask_all();
        chain_.push_back(missing);
    }
}

lod::Step RoamFront::refine() {
    lod::Step step;
    const uint64_t before = triangles();
    while (refine_error_px() > 0.0) {
        refined_ = splits().highest();
        const DiamondIndex head = splits().head(refined_);
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
    ask(kUnaskedMost);
    step.triangle_delta = static_cast<int64_t>(triangles() - before);
    return step;
}

/// Merges one diamond without split children; its record becomes a candidate again.
void RoamFront::merge_one(DiamondIndex index) {
    unlink(index);
    glides_.drop(index, mesh_[index].level);
    note_change(index, false);
    const MergeOutcome outcome = mesh_.merge(index);
    for (uint32_t i = 0; i < outcome.removed_count; ++i)
        dequeue(outcome.removed[i]);
    for (uint32_t i = 0; i < outcome.mergeable_count; ++i)
        offer(outcome.mergeable[i], Queue::kMerge);
    enqueue(index, Queue::kSplit);  // its evaluation watched for a rise, too
}

lod::Step RoamFront::coarsen(double limit_px) {
    lod::Step step;
    ask_all();
    if (coarsen_error_px() > limit_px) return step;
    const uint64_t before = triangles();
    const Bucket bucket = merges().lowest();
    const DiamondIndex head = merges().head(bucket);
    const Bucket limit = limit_px > 0.0 ? scale_.bucket_of(static_cast<float>(limit_px)) : kFlatBucket;
    // Where vertices glide, only what is out of view goes as a whole, except in a cut.
    const Bucket whole_limit = is_cut_ || options_.glide_s == 0.0 ? limit : kFlatBucket;
    const bool is_far_below = bucket == kHiddenBucket || bucket + kClimbMargin <= whole_limit;
    const DiamondIndex top = options_.is_pruning && is_far_below ? climb(head, whole_limit) : head;
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

void RoamFront::emit(const lod::View& view, lod::DrawList& out) {
    ask_all();
    tessellator_.emit({table_, mesh_, ranks_, bound_of_, glides_}, view, out);
}

std::unique_ptr<RoamFront> make_roam_front(const data::HeightGrid& grid, const RoamOptions& options) {
    return std::make_unique<RoamFront>(make_diamond_table(grid, options.threads), options);
}

}  // namespace terrain
