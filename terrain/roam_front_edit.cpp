// The front over ground that has changed: vertices to their new places, what they rest on evaluated anew.
#include <algorithm>
#include <utility>

#include "lod/base/check.h"
#include "terrain/displacement.h"
#include "terrain/roam_front.h"

namespace terrain {
namespace {

/// Everything below a diamond lies within this many reaches of its centre along each axis: 3 for square ones, whose
/// children reach one beyond their sides and so on, 2 for turned ones.
int family_reach(const Domain& domain, const Diamond& d) {
    return domain.reach(d.level) * ((d.level & 1) == 0 ? 3 : 2);
}

/// What is refined this long after an edit is refined because of it.
constexpr double kFresh_s = 1.0;

bool meets(const data::SampleRange& range, GridPoint centre, int reach) {
    return centre.x + reach >= range.min.x && centre.x - reach <= range.max.x &&
           centre.y + reach >= range.min.y && centre.y - reach <= range.max.y;
}

}  // namespace

FrontEditCounts RoamFront::edit(const GroundEdit& edit) {
    CHECK(!loader_ && options_.batch == 0);
    ask_all();  // candidates not yet asked hold no facts
    FrontEditCounts counts;
    counts.table = edit_table(edit, table_, options_.threads);
    if (edit.changed.is_empty()) return counts;
    for (DiamondIndex corner = 0; corner < kCornerCount; ++corner)
        take_facts(corner, table_.corners[corner], counts);
    const data::SampleRange range = changed_on_domain(table_.domain, edit.changed);
    if (!glides_.is_empty()) end_glides_over(range);
    if (options_.glide_s > 0.0) fresh_ground_.push_back({range, now_s_});
    list_touched(range, due_);
    for (DiamondIndex index : due_)
        take_facts(index, table_.at(mesh_[index].centre(), mesh_[index].level), counts);
    std::erase_if(due_, [&](DiamondIndex index) { return !is_queued(index); });
    for (size_t i = 0; i < due_.size(); i += 4)
        refresh(std::span(due_).subspan(i, std::min<size_t>(4, due_.size() - i)));
    counts.evaluations = due_.size();
    if (!glides_.is_empty()) {
        glides_.rebase(now_s_, [&](DiamondIndex index) { return bound(index).centre; });
        measure_steps();
        measure_glides();
    }
    return counts;
}

/// Records whose facts may have changed: those with something of the range below them. Each once: through its second
/// parent, where there is one.
void RoamFront::list_touched(const data::SampleRange& range, std::vector<DiamondIndex>& out) {
    out.clear();
    stack_.assign(1, kRoot);
    while (!stack_.empty()) {
        const DiamondIndex index = stack_.back();
        stack_.pop_back();
        out.push_back(index);
        if (!mesh_[index].is_split) continue;
        for (int side = 0; side < 4; ++side) {
            const DiamondIndex child = mesh_.child(index, side);
            if (!is_record(child)) continue;
            const Diamond& c = mesh_[child];
            const bool is_second = c.parent1 == index || !is_record(c.parent1);
            if (is_second && meets(range, c.centre(), family_reach(table_.domain, c)))
                stack_.push_back(child);
        }
    }
}

/// Facts as the table has them now; a vertex that moves is written anew, and its way is told with the next frame.
void RoamFront::take_facts(DiamondIndex index, const DiamondSource& now, FrontEditCounts& counts) {
    ++counts.records;
    const float before_m = std::exchange(ranks_[index].source, now).height_m;
    // What was said of a record in no queue holds no longer.
    if (!is_queued(index)) wake_m_[index] = wake_rad_[index] = kNever;
    if (before_m == now.height_m) return;
    if (index >= kCornerCount && !mesh_[index].is_split) return;
    DiamondSource before = now;
    before.height_m = before_m;
    moved_.push_back({index, bound(index).centre - bound_of_(mesh_[index], before).centre});
    tessellator_.add_vertex(index);
    ++counts.vertices;
}

bool RoamFront::is_on_fresh_ground(DiamondIndex index) const {
    const Diamond& d = mesh_[index];
    return std::any_of(fresh_ground_.begin(), fresh_ground_.end(), [&](const FreshGround& fresh) {
        return meets(fresh.range, d.centre(), table_.domain.reach(d.level));
    });
}

/// What is under way over the range is where it goes; what was to leave stays, as it may be wanted now.
void RoamFront::end_glides_over(const data::SampleRange& range) {
    back_.clear();
    for (int level = 0; level <= table_.domain.finest_level(); ++level) {
        for (const VertexGlide& glide : glides_.at_level(level)) {
            if (!meets(range, mesh_[glide.index].centre(), table_.domain.reach(level))) continue;
            back_.push_back(glide.index);
            moved_.push_back({glide.index, -glide.shown_m});
        }
    }
    for (DiamondIndex index : back_) {
        glides_.drop(index, mesh_[index].level);
        tessellator_.add_vertex(index);
        if (queue_of(index) != Queue::kLeave) continue;
        leaving_triangles_ -= triangles_of(index);
        unlink(index);
        enqueue(index, Queue::kMerge);
    }
}

/// Tells how far the ground's own changes moved what is in view; before anything of the mesh changes.
void RoamFront::measure_edit() {
    std::erase_if(fresh_ground_, [&](const FreshGround& fresh) {
        return !(now_s_ >= fresh.since_s && now_s_ <= fresh.since_s + kFresh_s);
    });
    edited_px_ = 0.0;
    for (const MovedVertex& moved : moved_)
        edited_px_ = std::max(edited_px_, shift_px(moved.index, moved.way_m));
    moved_.clear();
}

}  // namespace terrain
