// SlotPool: ranges of a growing buffer in sizes of powers of two, each size with its own free list.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace terrain {

class SlotPool {
  public:
    struct Slot {
        uint32_t first = 0;
        uint32_t capacity = 0;  ///< a power of two; 0: no slot
    };

    /// Moves to a slot that holds `count`, unless this one does and is not four times too large. What it held is
    /// lost.
    void fit(Slot& slot, uint32_t count) {
        const uint32_t capacity = std::bit_ceil(count);
        if (slot.capacity >= capacity && slot.capacity / 4 < capacity) return;
        if (slot.capacity > 0) free_[size_class(slot.capacity)].push_back(slot.first);
        std::vector<uint32_t>& list = free_[size_class(capacity)];
        if (list.empty()) {
            slot = {top_, capacity};
            top_ += capacity;
        } else {
            slot = {list.back(), capacity};
            list.pop_back();
        }
    }

    /// All slots lie below this.
    uint32_t top() const { return top_; }

  private:
    static size_t size_class(uint32_t capacity) { return static_cast<size_t>(std::countr_zero(capacity)); }

    std::array<std::vector<uint32_t>, 32> free_;
    uint32_t top_ = 0;
};

}  // namespace terrain
