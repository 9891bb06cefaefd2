// Ranking: a fixed set of items 0 … n - 1 with changing keys, the largest at hand.
//
// A binary heap that knows where each item is. Ties go to the smaller item, so the order is total.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace terrain {

class Ranking {
  public:
    /// All keys 0.
    explicit Ranking(size_t count = 0) : keys_(count, 0.0), heap_(count), place_(count) {
        for (size_t i = 0; i < count; ++i)
            heap_[i] = place_[i] = static_cast<uint32_t>(i);
    }

    bool is_empty() const { return heap_.empty(); }
    uint32_t top() const { return heap_.front(); }
    double top_key() const { return keys_[heap_.front()]; }
    double key(uint32_t item) const { return keys_[item]; }

    /// O(log n).
    void set(uint32_t item, double key) {
        keys_[item] = key;
        sink(rise(place_[item]));
    }

    /// Changes a key without keeping order; reorder() must follow before anything else. O(1) each.
    void set_loosely(uint32_t item, double key) { keys_[item] = key; }
    /// O(n).
    void reorder() {
        for (size_t i = heap_.size() / 2; i-- > 0;)
            sink(i);
    }

    uint64_t memory_bytes() const { return keys_.size() * (sizeof(double) + 2 * sizeof(uint32_t)); }

  private:
    bool is_above(uint32_t a, uint32_t b) const {
        return keys_[a] > keys_[b] || (keys_[a] == keys_[b] && a < b);
    }
    void exchange(size_t i, size_t j) {
        std::swap(heap_[i], heap_[j]);
        place_[heap_[i]] = static_cast<uint32_t>(i);
        place_[heap_[j]] = static_cast<uint32_t>(j);
    }
    size_t rise(size_t i) {
        for (; i > 0 && is_above(heap_[i], heap_[(i - 1) / 2]); i = (i - 1) / 2)
            exchange(i, (i - 1) / 2);
        return i;
    }
    void sink(size_t i) {
        while (2 * i + 1 < heap_.size()) {
            size_t child = 2 * i + 1;
            if (child + 1 < heap_.size() && is_above(heap_[child + 1], heap_[child])) ++child;
            if (!is_above(heap_[child], heap_[i])) return;
            exchange(i, child);
            i = child;
        }
    }

    std::vector<double> keys_;
    std::vector<uint32_t> heap_, place_;
};

}  // namespace terrain
