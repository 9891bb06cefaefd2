#include "terrain/patch_vertices.h"

#include <algorithm>
#include <bit>

#include "lod/base/check.h"
#include "lod/base/hash.h"

namespace terrain {
namespace {

constexpr uint32_t kNone = 0xffffffffu;

size_t home_of(GridPoint centre, size_t mask) {
    return static_cast<size_t>(
               lod::mix64(static_cast<uint64_t>(centre.y) << 32 | static_cast<uint64_t>(centre.x))) &
           mask;
}

}  // namespace

void PatchVertices::reset(uint32_t first, uint32_t capacity) {
    first_ = first;
    capacity_ = capacity;
    places_.reserve(capacity);
    free_.reserve(capacity);
    made_.reserve(capacity);
    cells_.resize(std::bit_ceil(size_t{capacity} * 2 + 2));
    clear();
}

void PatchVertices::clear() {
    places_.clear();
    free_.clear();
    made_.clear();
    std::fill(cells_.begin(), cells_.end(), kNone);
    is_overfull_ = false;
}

/// The cell that holds a sample, or the empty one where it belongs.
size_t PatchVertices::cell_of(GridPoint centre) const {
    const size_t mask = cells_.size() - 1;
    size_t cell = home_of(centre, mask);
    while (cells_[cell] != kNone && places_[cells_[cell]].centre() != centre)
        cell = (cell + 1) & mask;
    return cell;
}

uint32_t PatchVertices::slot_of(GridPoint centre, int level) {
    const size_t cell = cell_of(centre);
    if (cells_[cell] != kNone) return first_ + cells_[cell];
    uint32_t slot = static_cast<uint32_t>(places_.size());
    if (!free_.empty()) {
        slot = free_.back();
        free_.pop_back();
    } else if (slot < capacity_) {
        places_.emplace_back();
    } else {
        is_overfull_ = true;
        return first_;
    }
    places_[slot] = {centre.x, centre.y, static_cast<uint8_t>(level), 0};
    cells_[cell] = slot;
    made_.push_back(first_ + slot);
    return first_ + slot;
}

void PatchVertices::hold(uint32_t slot) {
    if (slot >= first_ && !is_overfull_) ++places_[slot - first_].uses;
}

void PatchVertices::release(std::span<const uint32_t> indices) {
    if (is_overfull_) return;  // they are about to be forgotten
    for (const uint32_t slot : indices) {
        if (slot < first_) continue;
        DCHECK(places_[slot - first_].uses > 0);
        if (--places_[slot - first_].uses == 0) forget(slot - first_);
    }
}

/// Takes a place out of the table: what follows it without a gap moves up where that brings it nearer home.
void PatchVertices::forget(uint32_t slot) {
    const size_t mask = cells_.size() - 1;
    size_t hole = cell_of(places_[slot].centre());
    for (size_t next = (hole + 1) & mask; cells_[next] != kNone; next = (next + 1) & mask) {
        const size_t home = home_of(places_[cells_[next]].centre(), mask);
        if (((next - home) & mask) < ((next - hole) & mask)) continue;
        cells_[hole] = cells_[next];
        hole = next;
    }
    cells_[hole] = kNone;
    free_.push_back(slot);
}

void PatchVertices::sweep() {
    // A slot that was given back and taken again in one frame is listed twice, with the same answer.
    std::sort(made_.begin(), made_.end());
    made_.erase(std::unique(made_.begin(), made_.end()), made_.end());
    for (const uint32_t slot : made_) {
        const size_t cell = cell_of(places_[slot - first_].centre());
        if (places_[slot - first_].uses == 0 && cells_[cell] == slot - first_) forget(slot - first_);
    }
}

}  // namespace terrain
