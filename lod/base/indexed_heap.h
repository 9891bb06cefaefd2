// IndexedHeap: a priority queue of the integers 0 … n - 1 whose priorities may change.
//
// The least key is on top. Keys must be a strict total order (settle ties in the key itself, no NaN); then the order of
// pops does not depend on the order of pushes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "lod/base/check.h"

namespace lod {

/// Key: copyable, with operator<. Four children a place: a heap half as deep, and those that are compared lie together.
template <typename Key>
class IndexedHeap {
  public:
    explicit IndexedHeap(uint32_t count) : place_(count, kAbsent) {}

    bool is_empty() const { return heap_.empty(); }
    bool contains(uint32_t index) const { return place_[index] != kAbsent; }
    /// @param index  that it contains
    const Key& key(uint32_t index) const { return heap_[place_[index]].key; }

    /// The index with the least key.
    uint32_t top() const {
        CHECK(!heap_.empty());
        return heap_[0].index;
    }

    /// Inserts `index`, or changes its key. O(log n).
    void set(uint32_t index, const Key& key) {
        if (!contains(index)) {
            place_[index] = static_cast<uint32_t>(heap_.size());
            heap_.emplace_back();
        }
        settle(place_[index], {key, index});
    }

    /// Takes `index` out if it is there. O(log n).
    void erase(uint32_t index) {
        const uint32_t place = std::exchange(place_[index], kAbsent);
        if (place == kAbsent) return;
        const Entry last = heap_.back();
        heap_.pop_back();
        if (last.index != index) settle(place, last);
    }

  private:
    static constexpr uint32_t kAbsent = 0xffffffffu, kChildren = 4;
    struct Entry {
        Key key{};
        uint32_t index = 0;
    };

    void put(uint32_t place, const Entry& entry) {
        heap_[place] = entry;
        place_[entry.index] = place;
    }
    /// Moves what is in the way of an entry, up or down from a place that is free.
    void settle(uint32_t place, const Entry& entry) {
        while (place > 0) {
            const uint32_t parent = (place - 1) / kChildren;
            if (!(entry.key < heap_[parent].key)) break;
            put(place, heap_[parent]);
            place = parent;
        }
        const auto count = static_cast<uint32_t>(heap_.size());
        for (uint32_t first = kChildren * place + 1; first < count; first = kChildren * place + 1) {
            uint32_t least = first;
            for (uint32_t child = first + 1; child < std::min(first + kChildren, count); ++child)
                least = heap_[child].key < heap_[least].key ? child : least;
            if (!(heap_[least].key < entry.key)) break;
            put(place, heap_[least]);
            place = least;
        }
        put(place, entry);
    }

    std::vector<Entry> heap_;
    std::vector<uint32_t> place_;  // [count] in heap_
};

}  // namespace lod
