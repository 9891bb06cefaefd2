#include "lod/progressive/mesh_body.h"

#include <algorithm>
#include <array>
#include <limits>

#include "lod/base/check.h"
#include "lod/screen_error.h"

namespace lod {
namespace {

/// An eye that moves by more than this share of its distance, or turns by more, has nothing in common with the last.
constexpr double kJumpShare = 0.3, kJump_rad = 0.5;
/// Collapses that move their vertices by no more go without a glide.
constexpr double kUnseenPop_px = 0.1;
/// After a longer pause nobody remembers the last picture.
constexpr double kLongestFrame_s = 0.5;
/// What the size policy says to the scheduler: by all means.
constexpr double kDemand_px = 1e6;

}  // namespace

MeshBody::MeshBody(const ProgressiveMesh& mesh, const MeshOptions& options)
    : options_(options),
      cut_(mesh),
      ranks_(mesh, options.ranks),
      glides_(mesh.hierarchy.node_count(), options.glide_s) {
    chain_.reserve(256);
    for (NodeId root : mesh.roots) {
        if (mesh.is_leaf(root)) continue;
        ranks_.enqueue(record_of(root), NodeQueue::kSplit);
        ranks_.wake(record_of(root));
    }
}

/// Nothing is under way any more: what came is there, what was leaving may go at once.
void MeshBody::settle() {
    for (const NodeGlide& glide : glides_.all()) {
        if (glide.shown_m != glm::vec3(0.0f)) strayed_.push_back(glide.node);
    }
    glides_.clear();
    BucketQueue& leaves = ranks_.queue_at(NodeQueue::kLeave);
    while (!leaves.is_empty()) {
        const uint32_t record = leaves.head(leaves.lowest());
        ranks_.unlink(record);
        ranks_.enqueue(record, NodeQueue::kMerge);
    }
    leaving_triangles_ = 0;
    glide_px_ = 0.0;
    forget_pops();
}

/// Whether an eye is somewhere else altogether.
bool MeshBody::has_jumped(std::span<const View> views_body) {
    bool jumps = views_body.size() != last_views_.size();
    for (size_t i = 0; i < views_body.size() && !jumps; ++i) {
        const View &now = views_body[i], &then = last_views_[i];
        const double distance = std::max(glm::distance(now.eye_world, mesh().centre), mesh().radius_m);
        jumps = glm::distance(now.eye_world, then.eye_world) > kJumpShare * distance ||
                glm::length(now.eye_from_world[2] - then.eye_from_world[2]) > kJump_rad;
    }
    last_views_.assign(views_body.begin(), views_body.end());
    return jumps;
}

void MeshBody::begin_frame(std::span<const View> views_body, double time_s) {
    bool is_seen = false;
    double size_px = 0.0;
    for (const View& view : views_body) {
        const ViewMetric metric = metric_of(view);
        const glm::dvec3 centre = metric.eye_from_world * (mesh().centre - metric.eye_world);
        if (distance_outside_m(metric, centre, mesh().radius_m) > 0.0) continue;
        is_seen = true;
        const double distance = std::max(glm::length(centre), mesh().radius_m);
        size_px = std::max(size_px, 2.0 * mesh().radius_m * metric.lambda_px / distance);
    }
    const bool wakes = is_seen && is_asleep_;
    const double passed_s = time_s - now_s_;
    now_s_ = time_s;
    set_out_px_ = 0.0;
    if (!is_seen && !is_asleep_) settle();
    is_asleep_ = !is_seen;
    if (is_asleep_) return;
    wanted_triangles_ = static_cast<uint64_t>(share_by_size(size_px) * mesh().triangle_count());
    const EyeOdometer::Step step = ranks_.begin_frame(views_body);
    const bool jumps = has_jumped(views_body);
    is_cut_ = wakes || jumps || step == EyeOdometer::Step::kIncomparable || passed_s < 0.0 ||
              passed_s > kLongestFrame_s;
    if (is_cut_) {
        settle();
    } else {
        advance_glides();
    }
    refresh_due();
}

void MeshBody::refresh_due() {
    const std::span<const uint32_t> due = ranks_.due();
    std::array<uint32_t, 4> some{};
    std::array<Bucket, 4> before{};
    for (size_t next = 0; next < due.size();) {
        size_t count = 0;
        for (; next < due.size() && count < some.size(); ++next) {
            if (ranks_.queue(due[next]) == NodeQueue::kNone) continue;
            before[count] = ranks_.bucket(due[next]);
            some[count++] = due[next];
        }
        ranks_.refresh({some.data(), count});
        for (size_t i = 0; i < count; ++i) {
            if (ranks_.queue(some[i]) == NodeQueue::kLeave && ranks_.bucket(some[i]) > before[i])
                stay(some[i]);
        }
    }
}

double MeshBody::refine_error_px() {
    BucketQueue& splits = ranks_.queue_at(NodeQueue::kSplit);
    while (!is_asleep_ && !splits.is_empty()) {
        const Bucket bucket = splits.highest();
        if (bucket == kHiddenBucket) return 0.0;
        if (!ranks_.is_fresh(splits.head(bucket))) {
            ranks_.refresh_head(NodeQueue::kSplit, bucket);
            continue;
        }
        if (options_.policy == DetailPolicy::kSize) return triangles() < wanted_triangles_ ? kDemand_px : 0.0;
        return bucket == kFlatBucket ? 1e-30 : double(ranks_.scale().upper_px(bucket));
    }
    return 0.0;
}

double MeshBody::coarsen_error_px() {
    constexpr double kNothing = std::numeric_limits<double>::infinity();
    BucketQueue& merges = ranks_.queue_at(NodeQueue::kMerge);
    while (!is_asleep_ && !merges.is_empty()) {
        const Bucket bucket = merges.lowest();
        const uint32_t head = merges.head(bucket);
        if (!ranks_.is_fresh(head)) {
            ranks_.refresh_head(NodeQueue::kMerge, bucket);
            continue;
        }
        const NodeId blocker = head == ready_ ? kNoNode : cut_.collapse_blocker(node_of(head));
        if (blocker != kNoNode) {
            ranks_.block(head, record_of(blocker));
            continue;
        }
        ready_ = head;
        if (options_.policy == DetailPolicy::kSize) {
            // Room for the largest single step, or the two would take turns.
            const uint64_t slack = 64 + wanted_triangles_ / 100;
            return triangles() > wanted_triangles_ + slack ? 0.0 : kNothing;
        }
        return bucket <= kFlatBucket ? 0.0 : double(ranks_.scale().lower_px(bucket));
    }
    return kNothing;
}

double MeshBody::error_px() const {
    if (is_asleep_) return 0.0;
    const BucketQueue& splits = ranks_.queue_at(NodeQueue::kSplit);
    const double settled = splits.is_empty() ? 0.0 : double(ranks_.scale().upper_px(splits.highest()));
    return std::max(settled, set_out_px_) + glide_px_;
}

void MeshBody::admit_children(NodeId node) {
    std::array<uint32_t, 2> records{};
    size_t count = 0;
    for (NodeId child : mesh().hierarchy.children[record_of(node)]) {
        if (!mesh().is_leaf(child)) records[count++] = record_of(child);
    }
    if (count > 0) ranks_.rank({records.data(), count}, false);
    for (size_t i = 0; i < count; ++i)
        ranks_.enqueue(records[i], NodeQueue::kSplit);
}

/// The node is active: with its sibling it may be collapsed.
void MeshBody::admit_parent(NodeId node) {
    const NodeId parent = mesh().hierarchy.parent[node];
    if (parent == kNoNode || !cut_.are_children_active(parent)) return;
    const uint32_t record = record_of(parent);
    ranks_.rank({&record, 1}, true);
    ranks_.enqueue(record, NodeQueue::kMerge);
}

void MeshBody::split_one(NodeId node) {
    const uint32_t record = record_of(node);
    const NodeId parent = mesh().hierarchy.parent[node];
    if (parent != kNoNode) {
        if (ranks_.queue(record_of(parent)) == NodeQueue::kLeave) stay(record_of(parent));
        ranks_.unlink(record_of(parent));
    }
    const glm::vec3 shown_m = mesh().hierarchy.position[node] + glides_.displacement_m(node);
    drop_glide(node);
    cut_.vsplit(node);
    ready_ = kNoRecord;
    ++operations_[OperationKind::kVsplit];
    ranks_.unlink(record);
    admit_children(node);
    // Its evaluation stands; that it does not watch for a fall yet only delays a collapse until it next wakes.
    ranks_.enqueue(record, NodeQueue::kMerge);
    if (!is_gliding(record)) return note_pop(record);
    set_out_px_ = std::max(set_out_px_, double(ranks_.scale().upper_px(ranks_.bucket(record))));
    for (NodeId child : mesh().hierarchy.children[record]) {
        const glm::vec3 from_m = shown_m - mesh().hierarchy.position[child];
        if (from_m != glm::vec3(0.0f)) glides_.come(child, from_m, now_s_);
    }
}

/// Collapses two active children; their node becomes a candidate again.
void MeshBody::merge_one(uint32_t record) {
    const NodeId node = node_of(record);
    if (ranks_.queue(record) != NodeQueue::kLeave) note_pop(record);
    for (NodeId child : mesh().hierarchy.children[record]) {
        if (!mesh().is_leaf(child)) ranks_.unlink(record_of(child));
        drop_glide(child);
    }
    ranks_.unlink(record);
    cut_.ecol(node);
    ready_ = kNoRecord;
    ++operations_[OperationKind::kEcol];
    ranks_.enqueue(record, NodeQueue::kSplit);  // its evaluation watched for a rise, too
    admit_parent(node);
    ranks_.release_blocked_by(record);
}

Step MeshBody::refine() {
    Step step;
    if (refine_error_px() <= 0.0) return step;
    const auto before = static_cast<int64_t>(triangles());
    const BucketQueue& splits = ranks_.queue_at(NodeQueue::kSplit);
    const uint32_t head = splits.head(splits.highest()), next = ranks_.behind(head);
    if (next != BucketQueue::kNone) cut_.expect_vsplit(node_of(next));
    chain_.assign(1, node_of(head));
    while (!chain_.empty()) {
        const NodeId node = chain_.back(), blocker = cut_.split_blocker(node);
        if (blocker != kNoNode) {
            chain_.push_back(blocker);
            continue;
        }
        split_one(node);
        ++step.steps;
        chain_.pop_back();
    }
    step.triangle_delta = static_cast<int64_t>(triangles()) - before;
    return step;
}

Step MeshBody::coarsen(double limit_px) {
    Step step;
    if (coarsen_error_px() > limit_px) return step;
    const auto before = static_cast<int64_t>(triangles());
    const BucketQueue& merges = ranks_.queue_at(NodeQueue::kMerge);
    const uint32_t record = merges.head(merges.lowest()), next = ranks_.behind(record);
    if (next != BucketQueue::kNone) cut_.expect_ecol(node_of(next));
    const bool glides = is_gliding(record) && pop_px(record) > kUnseenPop_px && leave(record);
    if (!glides) merge_one(record);
    step.steps = 1;
    step.triangle_delta = static_cast<int64_t>(triangles()) - before;
    return step;
}

}  // namespace lod
