// enhMerge: a split diamond goes with everything below it, neighbours included, in one operation. For frames in
// which little stays: turns, cuts, teleports.
#include <algorithm>
#include <limits>

#include "terrain/roam_front.h"

namespace terrain {
namespace {

/// Taking a diamond back costs about half of splitting it anew: below this share of diamonds worth keeping it is
/// cheaper to take back the root, which costs nothing, and split again.
constexpr double kKeepShare = 0.3;
/// Every so many records are asked.
constexpr DiamondIndex kSampleStride = 37;
/// Of its distance: what has moved by more is not where it was.
constexpr double kLeapShare = 0.25;

}  // namespace

/// The bucket of a diamond and, nearly always, of everything that hangs below it. A descendant may reach beyond its
/// ancestor, over a side it shares with a neighbour, but stays within sqrt(2) + 1 of its radius as far as the ground
/// there is no steeper. Good enough in a cut, where what goes too much is split again.
Bucket RoamFront::family_bucket(DiamondIndex index) {
    ++evaluations_;
    return static_cast<Bucket>(evaluate_some({&index, 1}, 2.4142136f).bucket[0]);
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
        if (queue_of(index) == Queue::kLeave) leaving_triangles_ -= triangles_of(index);
        glides_.drop(index, mesh_[index].level);
        note_change(index, false);
        if (!is_cut_ && wake_m_[index] == kNever) rank({&index, 1});
        note_pop(index);
        if (is_queued(index)) unlink(index);
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
        if (!d.is_used() || is_queued(index) || (d.is_split && d.split_kids > 0)) continue;
        offer(index, d.is_split ? Queue::kMerge : Queue::kSplit);
    }
    return count;
}

/// Whether a split diamond and every split one below it are within a limit, each by its own evaluation: what hangs
/// below may reach beyond the ground that the diamond's facts speak of.
bool RoamFront::is_family_within(DiamondIndex top, Bucket limit) {
    stack_.assign(1, top);
    merged_.clear();
    bool is_within = true;
    while (!stack_.empty() && is_within) {
        const DiamondIndex index = stack_.back();
        stack_.pop_back();
        if (has_met_[index]) continue;
        has_met_.set(index, true);
        merged_.push_back(index);
        if (wake_m_[index] == kNever) rank({&index, 1});
        is_within = bucket_of(index) < limit;
        for (int side = 0; side < 4 && is_within && mesh_[index].split_kids > 0; ++side) {
            const DiamondIndex child = mesh_.child(index, side);
            if (is_record(child) && mesh_[child].is_split) stack_.push_back(child);
        }
    }
    for (DiamondIndex index : merged_)
        has_met_.set(index, false);
    return is_within;
}

/// The highest ancestor that may go as well: everything below it is then within the limit.
DiamondIndex RoamFront::climb(DiamondIndex index, Bucket limit) {
    while (true) {
        const Diamond& d = mesh_[index];
        DiamondIndex next = kOutside;
        for (DiamondIndex parent : d.parents()) {
            if (!is_record(parent) || parent < kCornerCount) continue;
            if (is_family_within(parent, limit)) {
                next = parent;
                break;
            }
        }
        if (next == kOutside) return index;
        index = next;
    }
}

/// Whether most of what is split is out of sight or far below the tolerance, judged by a sample.
bool RoamFront::is_little_worth_keeping(Bucket limit) const {
    uint32_t asked = 0, kept = 0;
    for (DiamondIndex index = kRoot; index < mesh_.record_count(); index += kSampleStride) {
        if (!mesh_[index].is_used() || !mesh_[index].is_split) continue;
        ++asked;
        if (evaluate_some({&index, 1}, 1.0f).bucket[0] >= int32_t(limit)) ++kept;
    }
    return kept < kKeepShare * asked;
}

/// Top-down over a cut: what the eye cannot see, or sees far below the tolerance, goes whole.
void RoamFront::prune(Bucket limit) {
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
                (mesh_[child].parent1 == index || !is_record(mesh_[child].parent1))) {
                chain_.push_back(child);
            }
        }
    }
    if (mesh_.live_count() < before - before / 4) mesh_.tidy();
}

/// Whether the eye's last step moved most of what there is by a large part of its distance: nothing in the picture
/// is where it was. Judged by a sample.
bool RoamFront::is_leap() const {
    uint32_t asked = 0, moved = 0;
    for (DiamondIndex index = kRoot; index < mesh_.record_count(); index += kSampleStride) {
        if (!mesh_[index].is_used()) continue;
        const glm::vec3 centre = bound(index).centre;
        double nearest_m = std::numeric_limits<double>::infinity();
        for (const AnchoredEye& eye : odometer_.eyes())
            nearest_m = std::min(nearest_m, glm::length(glm::dvec3(centre) - eye.eye));
        ++asked;
        if (odometer_.step_m() + odometer_.step_rad() * nearest_m > kLeapShare * nearest_m) ++moved;
    }
    return 2 * moved > asked;
}

/// A cut: enhMerge of the root where little would stay, of the topmost superfluous otherwise.
void RoamFront::take_back_in_cut() {
    const Bucket limit = scale_.bucket_of(scale_.reference_px * 0.25f);
    if (!is_little_worth_keeping(scale_.bucket_of(scale_.reference_px))) return prune(limit);
    reset();
    due_.clear();
    ++operations_[lod::OperationKind::kEnhMerge];
}

}  // namespace terrain
