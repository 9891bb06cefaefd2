// RecordBits: one bit a record, most of them clear.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/diamond_mesh.h"

namespace terrain {

class RecordBits {
  public:
    /// Room for records below `count`; new ones are clear.
    void resize(size_t count) { words_.resize(count / 64 + 1); }
    bool operator[](DiamondIndex index) const { return (words_[index / 64] >> (index % 64) & 1) != 0; }
    void set(DiamondIndex index, bool value) {
        const uint64_t bit = uint64_t{1} << (index % 64);
        words_[index / 64] = value ? words_[index / 64] | bit : words_[index / 64] & ~bit;
        is_any_set_ = is_any_set_ || value;
    }
    /// Clears all. Cost: none when none has been set, else an eighth of a byte a record.
    void clear() {
        if (is_any_set_) std::fill(words_.begin(), words_.end(), 0);
        is_any_set_ = false;
    }

  private:
    std::vector<uint64_t> words_;
    bool is_any_set_ = false;
};

}  // namespace terrain
