#include "terrain/diamond_mesh.h"

#include "lod/base/check.h"
#include "lod/base/hash.h"

namespace terrain {
namespace {

/// Sides 0 and 3 touch the apex towards parent 0, sides 1 and 2 the one towards parent 1. Across such a side
/// lies another child of that same parent: the next one round (+1) or the one before (-1).
constexpr int kSharedParent[4] = {0, 1, 1, 0};
constexpr int kRingStep[4] = {-1, 1, -1, 1};
/// The side that shares parent p and is met when coming from the other side of the ring step.
constexpr int kSideOf[2][2] = {{0, 3}, {2, 1}};  // [parent][ring step: 0 is -1, 1 is +1]

uint64_t hash_of(const Diamond& d) {
    return lod::mix64((uint64_t(d.y) << 32) | d.x);
}

}  // namespace

DiamondMesh::DiamondMesh(const Domain& domain) : domain_(domain) {
    const int side = domain.side();
    for (GridPoint corner :
         {GridPoint{0, 0}, GridPoint{side, 0}, GridPoint{0, side}, GridPoint{side, side}}) {
        const DiamondIndex index = make_record(corner, 0);
        diamonds_[index].is_split = true;
    }
    const DiamondIndex root = make_record({side / 2, side / 2}, 0);
    CHECK(root == kRoot);
    // Parents of the root are the corners off its hypotenuse; direction 1 is (+, +).
    diamonds_[root].apex_dir = static_cast<uint16_t>(apex_direction(domain, {side / 2, side / 2}, 0)) & 7;
    const bool towards_far_corner = diamonds_[root].apex_dir == 1;
    diamonds_[root].parent[0] = towards_far_corner ? 3u : 2u;
    diamonds_[root].parent[1] = towards_far_corner ? 0u : 1u;
}

void DiamondMesh::reserve(uint64_t triangle_count) {
    diamonds_.reserve(triangle_count * 5 / 4 + 64);
    free_.reserve(triangle_count * 5 / 4 + 64);
    kids_.reserve(triangle_count / 2 + 64);
    free_kids_.reserve(triangle_count / 2 + 64);
    is_block_used_.reserve(triangle_count / 2 + 64);
}

void DiamondMesh::tidy() {
    is_block_used_.assign(kids_.size(), 0);
    free_.clear();
    for (DiamondIndex index = record_count(); index-- > kCornerCount;) {
        const Diamond& d = diamonds_[index];
        if (!d.is_used()) free_.push_back(index);
        if (d.is_used() && d.kids != kOutside) is_block_used_[d.kids] = 1;
    }
    free_kids_.clear();
    for (uint32_t block = static_cast<uint32_t>(kids_.size()); block-- > 0;) {
        if (is_block_used_[block] == 0) free_kids_.push_back(block);
    }
}

DiamondIndex DiamondMesh::make_record(GridPoint centre, int level) {
    DiamondIndex index;
    if (free_.empty()) {
        index = record_count();
        diamonds_.emplace_back();
    } else {
        index = free_.back();
        free_.pop_back();
        diamonds_[index] = Diamond{};
    }
    Diamond& d = diamonds_[index];
    d.x = static_cast<uint16_t>(centre.x);
    d.y = static_cast<uint16_t>(centre.y);
    d.level = static_cast<uint16_t>(level) & 31;
    return index;
}

void DiamondMesh::free_record(DiamondIndex index) {
    diamonds_[index].kids = kOutside;
    diamonds_[index].level = kFreeLevel;
    free_.push_back(index);
}

/// The diamond across a side of a split diamond, at the same level, and its side that faces back.
DiamondIndex DiamondMesh::neighbour(const Diamond& d, int side, int& neighbour_side) const {
    const int which = kSharedParent[side];
    const DiamondIndex parent = d.parent[which];
    if (!is_record(parent) || parent < kCornerCount) return kOutside;
    const DiamondIndex other = child(parent, d.slot(which) + kRingStep[side]);
    if (!is_record(other)) return kOutside;
    const int other_which = diamonds_[other].parent[0] == parent ? 0 : 1;
    neighbour_side = kSideOf[other_which][kRingStep[side] < 0 ? 1 : 0];
    return other;
}

DiamondIndex DiamondMesh::missing_parent(DiamondIndex index) const {
    const Diamond& d = diamonds_[index];
    for (int which = 0; which < 2; ++which) {
        if (d.parent[which] != kUnsplit) continue;
        int side = 0;
        return neighbour(diamonds_[d.parent[1 - which]], d.slot(1 - which), side);
    }
    return kOutside;
}

/// The other parent already has this child: ties the new one in.
DiamondIndex DiamondMesh::share_child(DiamondIndex index, int side, DiamondIndex other, int other_side) {
    const DiamondIndex shared = kids_[diamonds_[other].kids][static_cast<size_t>(other_side)];
    Diamond& c = diamonds_[shared];
    const int free_place = c.parent[0] == other ? 1 : 0;
    c.parent[free_place] = index;
    c.set_slot(free_place, side);
    return shared;
}

/// A new record for the child on a side of `parent`; kOutside where that is beyond the domain.
DiamondIndex DiamondMesh::make_child(const Diamond& parent, DiamondIndex index, int side) {
    const int direction = (parent.apex_dir + 2 * side + 1) & 7;
    const GridPoint centre = step_from(parent.centre(), direction, domain_.child_step(parent.level));
    if (!domain_.contains(centre)) return kOutside;
    const DiamondIndex made = make_record(centre, parent.level + 1);
    Diamond& c = diamonds_[made];
    c.apex_dir = static_cast<uint16_t>(direction + 4) & 7;
    c.parent[0] = index;
    c.slot0 = side & 3;
    const GridPoint beyond = step_from(centre, direction, domain_.reach(c.level));
    c.parent[1] = domain_.contains(beyond) ? kUnsplit : kOutside;
    return made;
}

uint32_t DiamondMesh::make_kids(DiamondIndex index, SplitOutcome& outcome) {
    uint32_t block;
    if (free_kids_.empty()) {
        block = static_cast<uint32_t>(kids_.size());
        kids_.emplace_back();
    } else {
        block = free_kids_.back();
        free_kids_.pop_back();
    }
    const Diamond parent = diamonds_[index];
    std::array<DiamondIndex, 4> kids;
    for (int side = 0; side < 4; ++side) {
        int other_side = 0;
        const DiamondIndex other = neighbour(parent, side, other_side);
        DiamondIndex& kid = kids[static_cast<size_t>(side)];
        if (other != kOutside && diamonds_[other].is_split) {
            kid = share_child(index, side, other, other_side);
        } else {
            kid = make_child(parent, index, side);
            if (kid != kOutside) outcome.created[outcome.created_count++] = kid;
        }
    }
    kids_[block] = kids;
    return block;
}

SplitOutcome DiamondMesh::split(DiamondIndex index) {
    SplitOutcome outcome;
    DCHECK(diamonds_[index].is_used() && !diamonds_[index].is_split);
    if (diamonds_[index].level < domain_.finest_level()) {
        const uint32_t block = make_kids(index, outcome);
        diamonds_[index].kids = block;  // the records may have moved
    }
    Diamond& d = diamonds_[index];
    d.is_split = true;
    hash_ ^= hash_of(d);
    for (DiamondIndex parent : d.parent) {
        DCHECK(parent != kUnsplit);
        if (!is_record(parent)) continue;
        ++triangles_;
        if (parent >= kCornerCount && diamonds_[parent].split_kids++ == 0) {
            outcome.no_longer_mergeable[outcome.no_longer_mergeable_count++] = parent;
        }
    }
    return outcome;
}

/// Takes a parent from a candidate; true when it was the last one and the record is gone.
bool DiamondMesh::drop_child(DiamondIndex child_index, DiamondIndex parent_index) {
    Diamond& c = diamonds_[child_index];
    const int which = c.parent[0] == parent_index ? 0 : 1;
    c.parent[which] = kUnsplit;
    if (is_record(c.parent[1 - which])) return false;
    free_record(child_index);
    return true;
}

MergeOutcome DiamondMesh::merge(DiamondIndex index) {
    MergeOutcome outcome;
    DCHECK(diamonds_[index].is_split && diamonds_[index].split_kids == 0 && index >= kCornerCount);
    if (diamonds_[index].kids != kOutside) {
        for (DiamondIndex c : kids_[diamonds_[index].kids]) {
            if (is_record(c) && drop_child(c, index)) outcome.removed[outcome.removed_count++] = c;
        }
        free_kids_.push_back(diamonds_[index].kids);
    }
    Diamond& d = diamonds_[index];
    d.kids = kOutside;
    d.is_split = false;
    hash_ ^= hash_of(d);
    for (DiamondIndex parent : d.parent) {
        if (!is_record(parent)) continue;
        --triangles_;
        if (parent >= kCornerCount && --diamonds_[parent].split_kids == 0) {
            outcome.mergeable[outcome.mergeable_count++] = parent;
        }
    }
    return outcome;
}

}  // namespace terrain
