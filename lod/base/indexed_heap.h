// IndexedHeap: a priority queue of the integers 0 … n - 1 whose priorities may change.
//
// The least key is on top. Keys must be a strict total order (settle ties in the key itself, no NaN); then the order of
// pops does not depend on the order of pushes.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "lod/base/check.h"

namespace lod {

/// Key: copyable, with operator<.
template <typename Key>
class IndexedHeap {
  public:
    explicit IndexedHeap(uint32_t count) : place_(count, kAbsent), keys_(count) {}

    bool is_empty() const { return heap_.empty(); }
    bool contains(uint32_t index) const { return place_[index] != kAbsent; }
    const Key& key(uint32_t index) const { return keys_[index]; }

    /// The index with the least key.
    uint32_t top() const {
        CHECK(!heap_.empty());
        return heap_[0];
    }

    /// Inserts `index`, or changes its key. O(log n).
    void set(uint32_t index, const Key& key) {
        keys_[index] = key;
        if (!contains(index)) {
            place_[index] = static_cast<uint32_t>(heap_.size());
            heap_.push_back(index);
        }
        sink(rise(place_[index]));
    }

    /// Takes `index` out if it is there. O(log n).
    void erase(uint32_t index) {
        const uint32_t place = place_[index];
        if (place == kAbsent) return;
        place_[index] = kAbsent;
        const uint32_t last = heap_.back();
        heap_.pop_back();
        if (last == index) return;
        heap_[place] = last;
        place_[last] = place;
        sink(rise(place));
    }

  private:
    static constexpr uint32_t kAbsent = 0xffffffffu;

    bool is_less(uint32_t a, uint32_t b) const { return keys_[heap_[a]] < keys_[heap_[b]]; }
    void swap(uint32_t a, uint32_t b) {
        std::swap(heap_[a], heap_[b]);
        place_[heap_[a]] = a;
        place_[heap_[b]] = b;
    }
    uint32_t rise(uint32_t place) {
        while (place > 0 && is_less(place, (place - 1) / 2)) {
            swap(place, (place - 1) / 2);
            place = (place - 1) / 2;
        }
        return place;
    }
    void sink(uint32_t place) {
        const auto count = static_cast<uint32_t>(heap_.size());
        for (;;) {
            uint32_t least = place;
            for (uint32_t child = 2 * place + 1; child < count && child <= 2 * place + 2; ++child)
                least = is_less(child, least) ? child : least;
            if (least == place) return;
            swap(place, least);
            place = least;
        }
    }

    std::vector<uint32_t> heap_;   // indices
    std::vector<uint32_t> place_;  // [count] in heap_
    std::vector<Key> keys_;        // [count]
};

}  // namespace lod
