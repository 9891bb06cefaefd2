#include "terrain/roam_front.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lod/base/check.h"

namespace terrain {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();
/// Odometers are floats in the records: they start again before a millimetre is lost.
constexpr double kOdometerLimit_m = 4096.0;
/// Once this share of the mesh must be looked at again, the frame is incoherent: prune top-down first.
constexpr size_t kIncoherentShare = 4;
/// Subtrees are worth taking back whole when their error is this many buckets (two octaves) below the limit.
constexpr int kClimbMargin = 16;

/// Chord of the rotation between two orientations: moves a point at distance 1 by at most this.
double rotation_chord(const glm::dmat3& a, const glm::dmat3& b) {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i)
        sum += glm::dot(a[i] - b[i], a[i] - b[i]);
    return std::sqrt(sum / 2.0);
}

}  // namespace

RoamFront::RoamFront(const data::HeightGrid& grid, DiamondTable table, const RoamOptions& options)
    : grid_(grid),
      table_(std::move(table)),
      options_(options),
      bound_of_(grid, table_.domain),
      mesh_(table_.domain) {
    scale_.reference_px = options.tolerance_px > 0.0 ? static_cast<float>(options.tolerance_px) : 1.0f;
    reset();
}

void RoamFront::reset() {
    split_queue_ = BucketQueue{};
    merge_queue_ = BucketQueue{};
    std::fill(ranks_.begin(), ranks_.end(), Rank{});
    std::fill(wake_m_.begin(), wake_m_.end(), kNever);
    std::fill(wake_rad_.begin(), wake_rad_.end(), kNever);
    mesh_ = DiamondMesh(table_.domain);
    mesh_.reserve(options_.reserve_triangles);
    grow_arrays();
    for (DiamondIndex corner = 0; corner < kCornerCount; ++corner) {
        tessellator_.add_vertex(corner);
    }
    ranks_[kRoot].source = table_.at(mesh_[kRoot].centre(), 0);
    enqueue(kRoot, Queue::kSplit);
    wake_m_[kRoot] = -1.0f;  // ranked by the next frame
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

Evaluation RoamFront::evaluate_now(DiamondIndex index, Watch watch) {
    ++evaluations_;
    return evaluate(bound(index), eyes_, scale_, watch);
}

/// The bucket of a diamond and of everything that hangs below it. A descendant may reach beyond its ancestor,
/// over a side it shares with a neighbour, but stays within sqrt(2) + 1 of its radius.
Bucket RoamFront::family_bucket(DiamondIndex index) {
    ++evaluations_;
    DiamondBound family = bound(index);
    family.radius_m *= 2.4142136f;
    return evaluate(family, eyes_, scale_, Watch::kRise).bucket;
}

/// Evaluates a record and sets when it wakes next.
void RoamFront::rank(DiamondIndex index, Watch watch) {
    const Evaluation now = evaluate_now(index, watch);
    RankTag& tag = mesh_.tag(index);
    tag.bucket = now.bucket;
    tag.stamp = stamp_ & 63;
    // The guard is shared out between walking and turning as this frame's motion is.
    const float walk_m = now.guard_m * walk_share_;
    const float turn_rad = (now.guard_m - walk_m) / (now.distance_m + walk_m + 1e-6f);
    wake_m_[index] = (walked_m_ + walk_m) * (1.0f - 0x1p-20f);
    wake_rad_[index] = (turned_rad_ + turn_rad) * (1.0f - 0x1p-20f);
}

void RoamFront::enqueue(DiamondIndex index, Queue queue) {
    DCHECK(queue_of(index) == Queue::kNone);
    mesh_.tag(index).queue = static_cast<uint8_t>(queue) & 3;
    queue_at(queue).push(ranks_, index, bucket_of(index));
}

void RoamFront::dequeue(DiamondIndex index) {
    if (queue_of(index) == Queue::kNone) return;
    unlink(index);
    wake_m_[index] = wake_rad_[index] = kNever;
}

/// Out of its queue, but still awake at its time.
void RoamFront::unlink(DiamondIndex index) {
    queue_at(queue_of(index)).remove(ranks_, index, bucket_of(index));
    mesh_.tag(index).queue = static_cast<uint8_t>(Queue::kNone) & 3;
}

/// Evaluates a queued record anew and moves it to its bucket.
void RoamFront::refresh(DiamondIndex index) {
    const Bucket before = bucket_of(index);
    const Queue queue = queue_of(index);
    rank(index, queue == Queue::kMerge ? Watch::kRiseAndFall : Watch::kRise);
    if (bucket_of(index) == before) return;
    queue_at(queue).remove(ranks_, index, before);
    queue_at(queue).push(ranks_, index, bucket_of(index));
}

/// A new candidate.
void RoamFront::admit(DiamondIndex index) {
    ranks_[index].source = table_.at(mesh_[index].centre(), mesh_[index].level);
    rank(index, Watch::kRise);
    enqueue(index, Queue::kSplit);
}

void RoamFront::advance_odometers(std::span<const lod::View> views) {
    bool is_comparable = views.size() == eyes_.size();
    double step_m = 0.0, step_rad = 0.0;
    for (size_t i = 0; i < views.size(); ++i) {
        const AnchoredEye now(views[i], bound_of_.anchor_world());
        if (i < eyes_.size()) {
            const lod::ViewMetric& then = eyes_[i].metric;
            is_comparable = is_comparable && then.lambda_px == now.metric.lambda_px &&
                            then.tan_x == now.metric.tan_x && then.tan_y == now.metric.tan_y &&
                            then.near_m == now.metric.near_m;
            step_m = std::max(step_m, glm::length(now.eye - eyes_[i].eye));
            step_rad = std::max(step_rad, rotation_chord(now.metric.eye_from_world, then.eye_from_world));
        }
    }
    eyes_.clear();
    for (const lod::View& view : views)
        eyes_.emplace_back(view, bound_of_.anchor_world());
    odometer_m_ += step_m;
    odometer_rad_ += step_rad;
    // At the distance where turning moves a point as far as walking does, both get one half.
    constexpr double kTypicalDistance_m = 2000.0;
    walk_share_ =
        static_cast<float>(std::clamp(step_m / (step_m + kTypicalDistance_m * step_rad + 1e-30), 0.1, 0.9));
    if (is_comparable && odometer_m_ < kOdometerLimit_m && odometer_rad_ < kOdometerLimit_m) return;
    // Other optics, or the odometers are full: start again. What sleeps keeps the rest of its guard, unless
    // the optics changed: then everything wakes.
    for (size_t i = 0; i < wake_m_.size(); ++i) {
        if (wake_m_[i] == kNever) continue;
        wake_m_[i] = is_comparable ? static_cast<float>((double(wake_m_[i]) - odometer_m_) - 1e-3) : -1.0f;
        wake_rad_[i] =
            is_comparable ? static_cast<float>((double(wake_rad_[i]) - odometer_rad_) - 1e-7) : -1.0f;
    }
    odometer_m_ = odometer_rad_ = 0.0;
}

/// Every record whose guard this frame's motion may have used up.
void RoamFront::collect_due() {
    constexpr size_t kBlock = 64;
    due_.clear();
    const float walked = walked_m_, turned = turned_rad_;
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

/// Top-down over an incoherent frame: what the eye cannot see, or sees far below the tolerance, goes whole.
void RoamFront::prune() {
    const Bucket limit = scale_.bucket_of(scale_.reference_px * 0.25f);
    const uint32_t before = mesh_.live_count();
    chain_.clear();
    if (mesh_[kRoot].is_split) chain_.push_back(kRoot);
    while (!chain_.empty()) {
        const DiamondIndex index = chain_.back();
        chain_.pop_back();
        if (!mesh_[index].is_used() || !mesh_[index].is_split) continue;
        if (family_bucket(index) < limit) {
            merge_subtree(index);
            ++operations_[lod::OperationKind::kEnhMerge];
            continue;
        }
        for (int side = 0; side < 4; ++side) {
            const DiamondIndex child = mesh_.child(index, side);
            // A diamond is reached through its second parent only, so that it is looked at once.
            if (is_record(child) && mesh_[child].is_split &&
                (mesh_[child].parent[1] == index || !is_record(mesh_[child].parent[1]))) {
                chain_.push_back(child);
            }
        }
    }
    if (mesh_.live_count() < before - before / 4) mesh_.tidy();
}

void RoamFront::begin_frame(std::span<const lod::View> views, double) {
    CHECK(!views.empty());
    advance_odometers(views);
    walked_m_ = static_cast<float>(odometer_m_);
    turned_rad_ = static_cast<float>(odometer_rad_);
    ++stamp_;
    tessellator_.begin_frame();
    collect_due();
    if (options_.is_pruning && due_.size() > mesh_.live_count() / kIncoherentShare && due_.size() > 64) {
        prune();
    }
    for (DiamondIndex index : due_) {
        if (queue_of(index) != Queue::kNone) refresh(index);
    }
}

double RoamFront::refine_error_px() {
    while (!split_queue_.is_empty()) {
        const Bucket bucket = split_queue_.highest();
        if (bucket == kHiddenBucket) return 0.0;
        const DiamondIndex head = split_queue_.head(bucket);
        if (!is_fresh(head)) {
            refresh(head);
            continue;
        }
        return bucket == kFlatBucket ? 1e-30 : double(scale_.upper_px(bucket));
    }
    return 0.0;
}

double RoamFront::coarsen_error_px() {
    while (!merge_queue_.is_empty()) {
        const Bucket bucket = merge_queue_.lowest();
        const DiamondIndex head = merge_queue_.head(bucket);
        if (!is_fresh(head)) {
            refresh(head);
            continue;
        }
        return bucket <= kFlatBucket ? 0.0 : double(scale_.lower_px(bucket));
    }
    return std::numeric_limits<double>::infinity();
}

double RoamFront::error_px() {
    if (split_queue_.is_empty()) return 0.0;
    return double(scale_.upper_px(split_queue_.highest()));
}

/// Splits one candidate whose parents are split.
uint32_t RoamFront::split_one(DiamondIndex index) {
    unlink(index);
    const SplitOutcome outcome = mesh_.split(index);
    grow_arrays();
    tessellator_.add_vertex(index);
    for (uint32_t i = 0; i < outcome.no_longer_mergeable_count; ++i)
        dequeue(outcome.no_longer_mergeable[i]);
    for (uint32_t i = 0; i < outcome.created_count; ++i)
        admit(outcome.created[i]);
    // Its evaluation stands; that it does not watch for a fall yet only delays a merge until it next wakes.
    enqueue(index, Queue::kMerge);
    return 1;
}

lod::Step RoamFront::refine() {
    lod::Step step;
    if (refine_error_px() <= 0.0) return step;
    const uint64_t before = mesh_.triangles();
    chain_.assign(1, split_queue_.head(split_queue_.highest()));
    while (!chain_.empty()) {
        const DiamondIndex missing = mesh_.missing_parent(chain_.back());
        if (missing != kOutside) {
            chain_.push_back(missing);
            continue;
        }
        step.steps += split_one(chain_.back());
        chain_.pop_back();
        ++operations_[chain_.empty() ? lod::OperationKind::kSplit : lod::OperationKind::kForcedSplit];
    }
    step.triangle_delta = static_cast<int64_t>(mesh_.triangles() - before);
    return step;
}

/// Merges one diamond without split children; its record becomes a candidate again.
void RoamFront::merge_one(DiamondIndex index) {
    unlink(index);
    const MergeOutcome outcome = mesh_.merge(index);
    for (uint32_t i = 0; i < outcome.removed_count; ++i)
        dequeue(outcome.removed[i]);
    for (uint32_t i = 0; i < outcome.mergeable_count; ++i) {
        rank(outcome.mergeable[i], Watch::kRiseAndFall);
        enqueue(outcome.mergeable[i], Queue::kMerge);
    }
    enqueue(index, Queue::kSplit);  // its evaluation watched for a rise, too
}

/// enhMerge: takes back `top` and every split diamond below it. Returns how many that were.
uint32_t RoamFront::merge_subtree(DiamondIndex top) {
    stack_.assign(1, top);
    merged_.clear();
    uint32_t count = 0;
    while (!stack_.empty()) {
        const DiamondIndex index = stack_.back();
        DiamondIndex below = kOutside;
        for (int side = 0; side < 4 && mesh_[index].split_kids > 0; ++side) {
            const DiamondIndex child = mesh_.child(index, side);
            if (is_record(child) && mesh_[child].is_split) {
                below = child;
                break;
            }
        }
        if (below != kOutside) {
            stack_.push_back(below);
            continue;
        }
        stack_.pop_back();
        dequeue(index);
        const MergeOutcome outcome = mesh_.merge(index);
        ++count;
        merged_.push_back(index);
        for (uint32_t i = 0; i < outcome.removed_count; ++i)
            dequeue(outcome.removed[i]);
        for (uint32_t i = 0; i < outcome.mergeable_count; ++i)
            merged_.push_back(outcome.mergeable[i]);
    }
    // What survived: the rim, as candidates or as diamonds that can be merged next.
    for (DiamondIndex index : merged_) {
        const Diamond& d = mesh_[index];
        if (!d.is_used() || queue_of(index) != Queue::kNone || (d.is_split && d.split_kids > 0)) continue;
        rank(index, d.is_split ? Watch::kRiseAndFall : Watch::kRise);
        enqueue(index, d.is_split ? Queue::kMerge : Queue::kSplit);
    }
    return count;
}

/// The highest ancestor that may go as well: everything below it is then within the limit.
DiamondIndex RoamFront::climb(DiamondIndex index, Bucket limit) {
    while (true) {
        const Diamond& d = mesh_[index];
        DiamondIndex next = kOutside;
        for (DiamondIndex parent : d.parent) {
            if (!is_record(parent) || parent < kCornerCount) continue;
            if (family_bucket(parent) < limit) {
                next = parent;
                break;
            }
        }
        if (next == kOutside) return index;
        index = next;
    }
}

lod::Step RoamFront::coarsen(double limit_px) {
    lod::Step step;
    if (coarsen_error_px() > limit_px) return step;
    const uint64_t before = mesh_.triangles();
    const Bucket bucket = merge_queue_.lowest();
    const DiamondIndex head = merge_queue_.head(bucket);
    const Bucket limit = limit_px > 0.0 ? scale_.bucket_of(static_cast<float>(limit_px)) : kFlatBucket;
    const bool is_far_below = bucket == kHiddenBucket || bucket + kClimbMargin <= limit;
    const DiamondIndex top = options_.is_pruning && is_far_below ? climb(head, limit) : head;
    if (top == head) {
        merge_one(head);
        step.steps = 1;
        ++operations_[lod::OperationKind::kMerge];
    } else {
        step.steps = merge_subtree(top);
        ++operations_[lod::OperationKind::kEnhMerge];
    }
    step.triangle_delta = static_cast<int64_t>(mesh_.triangles()) - static_cast<int64_t>(before);
    return step;
}

lod::PoolRegion RoamFront::pool_need() const {
    const uint64_t triangles = std::max(mesh_.triangles(), options_.reserve_triangles);
    const uint64_t records =
        std::max<uint64_t>(mesh_.record_count(), options_.reserve_triangles * 5 / 4 + 64);
    return Tessellator::need(triangles, static_cast<uint32_t>(records));
}

void RoamFront::emit(const lod::View& view, lod::DrawList& out) {
    tessellator_.emit({grid_, table_, mesh_, bound_of_}, view, out);
}

std::unique_ptr<RoamFront> make_roam_front(const data::HeightGrid& grid, const RoamOptions& options) {
    return std::make_unique<RoamFront>(grid, make_diamond_table(grid, options.threads), options);
}

}  // namespace terrain
