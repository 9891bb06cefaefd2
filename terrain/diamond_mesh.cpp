#include "terrain/diamond_mesh.h"

#include "lod/base/check.h"
#include "lod/base/hash.h"

namespace terrain {
namespace {

/// Sides 0 and 3 touch the apex towards parent 0, sides 1 and 2 the one towards parent 1. Across such a side
/// lies another child of that same parent: the one before (+3) or the next one round (+1).
constexpr uint32_t kSharedParent[4] = {0, 1, 1, 0};
constexpr uint32_t kRingStep[4] = {3, 1, 3, 1};
/// The side of a neighbour that faces back over `side`, when the shared parent is its parent 0 or 1.
constexpr uint8_t kFacing[4][2] = {{3, 1}, {0, 2}, {3, 1}, {0, 2}};  // [side][its parent]

uint64_t hash_of(const Diamond& d) {
    return lod::mix64((uint64_t(d.y) << 32) | d.x);
}

}  // namespace

DiamondMesh::DiamondMesh(const Domain& domain) : domain_(domain) {
    clear();
}

void DiamondMesh::clear() {
    diamonds_.clear();
    kids_.assign(1, {kOutside, kOutside, kOutside, kOutside});
    free_.clear();
    free_kids_.clear();
    triangles_ = 2;
    hash_ = 0;
    const int side = domain_.side();
    for (GridPoint corner :
         {GridPoint{0, 0}, GridPoint{side, 0}, GridPoint{0, side}, GridPoint{side, side}}) {
        Diamond d;
        d.set_centre(corner);
        d.is_split = true;
        add_record(d);
    }
    Diamond root;
    root.set_centre({side / 2, side / 2});
    // Parents of the root are the corners off its hypotenuse; direction 1 is (+, +).
    root.apex_dir = static_cast<uint32_t>(apex_direction(domain_, root.centre(), 0)) & 7;
    root.parent0 = root.apex_dir == 1 ? 3u : 2u;
    root.parent1 = root.apex_dir == 1 ? 0u : 1u;
    CHECK(add_record(root) == kRoot);
}

void DiamondMesh::fetch_kin(DiamondIndex index) const {
    for (DiamondIndex parent : diamonds_[index].parents()) {
        if (!is_record(parent)) continue;
        for (DiamondIndex sibling : kids_[diamonds_[parent].kids]) {
            if (is_record(sibling)) fetch(sibling);
        }
    }
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
        if (d.is_used()) is_block_used_[d.kids] = 1;
    }
    free_kids_.clear();
    for (uint32_t block = static_cast<uint32_t>(kids_.size()); block-- > 1;) {
        if (is_block_used_[block] == 0) free_kids_.push_back(block);
    }
}

DiamondIndex DiamondMesh::add_record(const Diamond& d) {
    if (free_.empty()) {
        CHECK(record_count() < kUnsplit);
        diamonds_.push_back(d);
        return record_count() - 1;
    }
    const DiamondIndex index = free_.back();
    free_.pop_back();
    diamonds_[index] = d;
    return index;
}

void DiamondMesh::free_record(DiamondIndex index) {
    diamonds_[index].kids = kNoKids;
    diamonds_[index].level = kFreeLevel;
    free_.push_back(index);
}

/// The child that a diamond shares with its neighbour across a side, at the same level; kOutside where there is no
/// such neighbour, or none that is split. Without branches: which of four neighbours exist is as good as random.
DiamondIndex DiamondMesh::shared_child(const Diamond& d, uint32_t side) const {
    const uint32_t which = kSharedParent[side];
    const DiamondIndex parent = d.parent(which);
    const uint32_t block = is_record(parent) ? diamonds_[parent].kids : kNoKids;
    const DiamondIndex across = kids_[block][(d.slot(which) + kRingStep[side]) & 3];
    // Corner 0 stands for nobody: like whatever is not split, it has no children.
    const Diamond& other = diamonds_[across == kOutside ? 0 : across];
    return kids_[other.kids][kFacing[side][other.parent0 == parent ? 0 : 1]];
}

DiamondIndex DiamondMesh::missing_parent(DiamondIndex index) const {
    const Diamond& d = diamonds_[index];
    for (uint32_t which = 0; which < 2; ++which) {
        if (d.parent(which) != kUnsplit) continue;
        // Its neighbour across the side that it lies on; they share the diamond's parent on that side.
        const Diamond& known = diamonds_[d.parent(1 - which)];
        const uint32_t side = d.slot(1 - which), shared = kSharedParent[side];
        const uint32_t block = diamonds_[known.parent(shared)].kids;
        return kids_[block][(known.slot(shared) + kRingStep[side]) & 3];
    }
    return kOutside;
}

/// The other parent already has this child: ties the new one in.
void DiamondMesh::share_child(DiamondIndex child, DiamondIndex index, uint32_t side) {
    Diamond& c = diamonds_[child];
    c.set_parent(c.parent0 == kUnsplit ? 0 : 1, index, side);
}

/// Whether a point lies inside the domain, off its border.
bool DiamondMesh::is_inside(GridPoint p) const {
    const auto last = static_cast<unsigned>(domain_.side() - 1);
    return static_cast<unsigned>(p.x - 1) < last && static_cast<unsigned>(p.y - 1) < last;
}

/// A new record for the child on a side of `parent`.
DiamondIndex DiamondMesh::make_child(const Diamond& parent, DiamondIndex index, uint32_t side,
                                     GridPoint centre) {
    Diamond c;
    c.set_centre(centre);
    c.set_parent(0, index, side);
    // A diamond on the border is half a diamond.
    c.parent1 = is_inside(centre) ? kUnsplit : kOutside;
    c.level = static_cast<uint32_t>(parent.level + 1) & 63;
    c.apex_dir = static_cast<uint32_t>(parent.apex_dir + 2 * side + 5) & 7;
    return add_record(c);
}

uint32_t DiamondMesh::make_kids(DiamondIndex index, SplitOutcome& outcome) {
    uint32_t block = static_cast<uint32_t>(kids_.size());
    if (free_kids_.empty()) {
        kids_.emplace_back();
    } else {
        block = free_kids_.back();
        free_kids_.pop_back();
    }
    const Diamond parent = diamonds_[index];
    std::array<DiamondIndex, 4> kids;
    for (uint32_t side = 0; side < 4; ++side)
        kids[side] = shared_child(parent, side);
    const bool is_whole = is_inside(parent.centre());
    const int step = domain_.child_step(parent.level);
    for (uint32_t side = 0; side < 4; ++side) {
        if (kids[side] != kOutside) {
            share_child(kids[side], index, side);
            continue;
        }
        const GridPoint centre = step_from(parent.centre(), parent.apex_dir + 2 * int(side) + 1, step);
        if (!is_whole && !domain_.contains(centre)) continue;
        kids[side] = make_child(parent, index, side, centre);
        outcome.created[outcome.created_count++] = kids[side];
    }
    kids_[block] = kids;
    return block;
}

/// The record of a point that ends the diamond's hypotenuse. It is a corner of each parent as well: its apex, or the
/// end of its own hypotenuse.
DiamondIndex DiamondMesh::corner_at(DiamondIndex index, GridPoint point) const {
    while (index != kRoot) {
        const Diamond& d = diamonds_[index];
        index = is_record(d.parent0) ? d.parent0 : d.parent1;
        for (DiamondIndex apex : diamonds_[index].parents()) {
            if (is_record(apex) && diamonds_[apex].centre() == point) return apex;
        }
    }
    return (point.x == 0 ? 0u : 1u) + (point.y == 0 ? 0u : 2u);
}

std::array<DiamondIndex, 2> DiamondMesh::edge_ends(DiamondIndex index) const {
    const Diamond& d = diamonds_[index];
    const int reach = domain_.reach(d.level);
    return {corner_at(index, step_from(d.centre(), d.apex_dir + 2, reach)),
            corner_at(index, step_from(d.centre(), d.apex_dir + 6, reach))};
}

SplitOutcome DiamondMesh::split(DiamondIndex index) {
    SplitOutcome outcome;
    DCHECK(diamonds_[index].is_used() && !diamonds_[index].is_split);
    if (diamonds_[index].level < domain_.finest_level()) {
        const uint32_t block = make_kids(index, outcome);
        diamonds_[index].kids = block & kOutside;  // the records may have moved
    }
    Diamond& d = diamonds_[index];
    d.is_split = true;
    hash_ ^= hash_of(d);
    for (DiamondIndex parent : d.parents()) {
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
    const uint32_t which = c.parent0 == parent_index ? 0 : 1;
    c.set_parent(which, kUnsplit, 0);
    if (is_record(c.parent(1 - which))) return false;
    free_record(child_index);
    return true;
}

MergeOutcome DiamondMesh::merge(DiamondIndex index) {
    MergeOutcome outcome;
    DCHECK(diamonds_[index].is_split && diamonds_[index].split_kids == 0 && index >= kCornerCount);
    if (diamonds_[index].kids != kNoKids) {
        for (DiamondIndex c : kids_[diamonds_[index].kids]) {
            if (is_record(c) && drop_child(c, index)) outcome.removed[outcome.removed_count++] = c;
        }
        free_kids_.push_back(diamonds_[index].kids);
    }
    Diamond& d = diamonds_[index];
    d.kids = kNoKids;
    d.is_split = false;
    hash_ ^= hash_of(d);
    for (DiamondIndex parent : d.parents()) {
        if (!is_record(parent)) continue;
        --triangles_;
        if (parent >= kCornerCount && --diamonds_[parent].split_kids == 0) {
            outcome.mergeable[outcome.mergeable_count++] = parent;
        }
    }
    return outcome;
}

}  // namespace terrain
