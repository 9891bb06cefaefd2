#include "objects/cluster_front.h"

#include <algorithm>
#include <limits>

#include "lod/base/check.h"

namespace objects {
namespace {

bool is_same(const lod::View& a, const lod::View& b) {
    return a.eye_world == b.eye_world && a.eye_from_world == b.eye_from_world && a.fov_y_rad == b.fov_y_rad &&
           a.width_px == b.width_px && a.height_px == b.height_px && a.near_m == b.near_m;
}

bool are_same(std::span<const lod::View> a, std::span<const lod::View> b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), is_same);
}

}  // namespace

ClusterFront::ClusterFront(ClusterTree tree, const ScenePlace& place)
    : tree_(std::move(tree)), place_(place), cut_(tree_.clusters.size()) {
    CHECK(!tree_.clusters.empty());
    add(kRootCluster);
}

void ClusterFront::stand_at(const ScenePlace& place) {
    place_ = place;
    views_.clear();  // what was seen was seen elsewhere
    occlusion_.clear();
}

void ClusterFront::look_up_presence(CutRecord& record) {
    ++presence_lookups_;
    record.presence = presence_at(tree_, tree_.clusters[record.id].visibility, time_s_);
}

void ClusterFront::evaluate(CutRecord& record) {
    record.is_seen = record.is_hidden = false;
    record.error_px = 0.0;
    if (record.presence.share <= 0.0 || sights_.empty()) return;
    ++evaluations_;
    const Cluster& cluster = tree_.clusters[record.id];
    const double error_m = timed_error_m(cluster, record.presence.share);
    for (size_t eye = 0; eye < sights_.size(); ++eye) {
        const lod::EyeBox box = box_in_eye(tree_, cluster, sights_[eye], time_s_);
        const ClusterSight sight = sight_of(sights_[eye], box, error_m);
        if (!sight.is_seen) continue;
        if (occlusion_.hides(eye, box)) {
            record.is_hidden = true;
            continue;
        }
        record.is_seen = true;
        record.error_px = std::max(record.error_px, sight.error_px);
    }
}

void ClusterFront::count_triangles(const CutRecord& record, int64_t sign) {
    const uint32_t geometry = tree_.clusters[record.id].geometry;
    if (record.is_refined || record.presence.share < 0.5 || geometry == kNoGeometry) return;
    triangles_ += static_cast<uint64_t>(sign * int64_t(tree_.geometries[geometry].index_count / 3));
}

/// Puts a record where its next operation is looked for.
void ClusterFront::offer(const CutRecord& record) {
    if (record.is_refined) {
        if (!needs_children(record)) cheapest_.push(record.error_px, record.id);
    } else if (record.error_px > 0.0 && !tree_.is_leaf(record.id)) {  // a leaf is exact
        worst_.push(record.error_px, record.id);
    }
}

void ClusterFront::add(ClusterId id) {
    CutRecord& record = cut_.add(id);
    look_up_presence(record);
    evaluate(record);
    count_triangles(record, 1);
    hash_ += cluster_hash(id);
    offer(record);
}

void ClusterFront::remove(ClusterId id) {
    const CutRecord& record = cut_.at(id);
    is_uncovered_ = is_uncovered_ || record.is_occluder;
    count_triangles(record, -1);
    if (!record.is_refined) hash_ -= cluster_hash(id);
    cut_.remove(id);
}

void ClusterFront::begin_frame(std::span<const lod::View> views, double time_s) {
    CHECK(!views.empty());
    jump_px_ = 0.0;
    const double time = clamped_time(tree_, time_s);
    const bool is_new_time = time != time_s_;
    const bool is_new_view = !are_same(views, views_);
    // Looking at everything again for what may be hidden by now pays when much has changed.
    const bool looks_at_all = is_new_view || (hiding_ != Hiding::kNothing && changes_ > cut_.size() / 8);
    if (!is_new_time && !looks_at_all) return;
    time_s_ = time;
    if (is_new_view) {
        views_.assign(views.begin(), views.end());
        sights_.clear();
        for (const lod::View& view : views_)
            sights_.emplace_back(view, place_);
    }
    worst_.clear();
    cheapest_.clear();
    to_open_.clear();
    for (CutRecord& record : cut_) {
        record.has_event = !record.presence.holds_at(time);
        if (!record.has_event) continue;
        count_triangles(record, -1);
        look_up_presence(record);
        count_triangles(record, 1);
        is_uncovered_ = is_uncovered_ || record.is_occluder;
    }
    const bool hides_anew =
        hiding_ != Hiding::kNothing && (looks_at_all || occlusion_.moves() || is_uncovered_);
    if (hides_anew) cover();
    if (looks_at_all) changes_ = 0;
    uint64_t hidden = 0, seen = 0;
    for (CutRecord& record : cut_) {
        if (looks_at_all || record.has_event || tree_.moves(record.id) || (hides_anew && record.is_hidden))
            evaluate(record);
        hidden += record.is_hidden;
        seen += record.is_seen;
        offer(record);
        if (!record.is_refined && needs_children(record)) to_open_.push_back(record.id);
    }
    if (looks_at_all) occlusion_.learn(hidden, seen);
    for (ClusterId id : to_open_)
        open(id);
}

/// From now on solids of what is drawn now hide.
void ClusterFront::cover() {
    occlusion_.begin(tree_, views_, sights_, {cut_.begin(), cut_.end()}, time_s_);
    is_uncovered_ = false;
}

/// Looks again at what was hidden when something that hid it is no longer drawn.
bool ClusterFront::settle() {
    if (!is_uncovered_) return false;
    cover();
    to_open_.clear();
    for (CutRecord& record : cut_) {
        if (!record.is_hidden) continue;
        evaluate(record);
        offer(record);
        if (!record.is_refined && needs_children(record)) to_open_.push_back(record.id);
    }
    for (ClusterId id : to_open_)
        open(id);
    return true;
}

double ClusterFront::refine_error_px() {
    for (; !worst_.is_empty(); worst_.pop()) {
        const ClusterId id = worst_.top();
        if (cut_.holds(id) && !cut_.at(id).is_refined && cut_.at(id).error_px == worst_.top_error_px())
            return worst_.top_error_px();
    }
    return 0.0;
}

double ClusterFront::coarsen_error_px() {
    for (; !cheapest_.is_empty(); cheapest_.pop()) {
        const ClusterId id = cheapest_.top();
        if (cut_.holds(id) && cut_.at(id).is_refined && cut_.at(id).error_px == cheapest_.top_error_px())
            return cheapest_.top_error_px();
    }
    return std::numeric_limits<double>::infinity();
}

double ClusterFront::error_px() {
    settle();
    return refine_error_px();
}

/// In view, and nothing to draw for it but its children.
bool ClusterFront::needs_children(const CutRecord& record) const {
    const Cluster& cluster = tree_.clusters[record.id];
    return record.is_seen && cluster.geometry == kNoGeometry && cluster.child_count > 0;
}

/// Replaces an active cluster by its children, and children that must be opened by theirs. Returns how many came.
uint32_t ClusterFront::open(ClusterId id) {
    uint32_t come = 0;
    stack_.assign(1, id);
    while (!stack_.empty()) {
        const ClusterId top = stack_.back();
        stack_.pop_back();
        CutRecord& record = cut_.at(top);
        count_triangles(record, -1);
        record.is_refined = true;
        is_uncovered_ = is_uncovered_ || record.is_occluder;
        ++changes_;
        hash_ -= cluster_hash(top);
        offer(record);
        const Cluster& cluster = tree_.clusters[top];
        for (uint32_t i = 0; i < cluster.child_count; ++i) {
            const ClusterId child = cluster.first_child + i;
            add(child);
            if (needs_children(cut_.at(child))) stack_.push_back(child);
        }
        come += cluster.child_count;
    }
    return come;
}

lod::Step ClusterFront::refine() {
    if (refine_error_px() <= 0.0) return {};
    const ClusterId id = worst_.top();
    worst_.pop();
    const uint64_t before = triangles_;
    jump_px_ = std::max(jump_px_, cut_.at(id).error_px);
    const uint32_t come = open(id);
    ++operations_[lod::OperationKind::kClusterRefine];
    return {static_cast<int64_t>(triangles_ - before), come};
}

/// Makes a refined cluster active; everything below it goes. Returns how many clusters went.
uint32_t ClusterFront::take_back(ClusterId id) {
    uint32_t gone = 0;
    stack_.assign(1, id);
    while (!stack_.empty()) {
        const Cluster& above = tree_.clusters[stack_.back()];
        stack_.pop_back();
        for (uint32_t i = 0; i < above.child_count; ++i) {
            const ClusterId child = above.first_child + i;
            if (cut_.at(child).is_refined) stack_.push_back(child);
            remove(child);
        }
        gone += above.child_count;
    }
    CutRecord& record = cut_.at(id);
    record.is_refined = false;
    ++changes_;
    hash_ += cluster_hash(id);
    count_triangles(record, 1);
    offer(record);
    jump_px_ = std::max(jump_px_, record.error_px);
    return gone;
}

lod::Step ClusterFront::coarsen(double limit_px) {
    if (coarsen_error_px() > limit_px) return {};
    const ClusterId id = cheapest_.top();
    cheapest_.pop();
    const uint64_t before = triangles_;
    const uint32_t gone = take_back(id);
    ++operations_[lod::OperationKind::kClusterCoarsen];
    return {static_cast<int64_t>(triangles_ - before), gone};
}

}  // namespace objects
