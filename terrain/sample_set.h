// SampleSet: a set of grid points, one bit each, that can number its members.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/diamond.h"

namespace terrain {

/// Points of a columns x rows rectangle. 1.5 bits a point once numbered.
class SampleSet {
  public:
    SampleSet(int columns, int rows)
        : columns_(static_cast<size_t>(columns)), words_(columns_ * static_cast<size_t>(rows) / 64 + 1) {}

    bool has(GridPoint p) const { return (words_[index(p) / 64] >> (index(p) % 64) & 1) != 0; }
    void add(GridPoint p) { words_[index(p) / 64] |= uint64_t{1} << (index(p) % 64); }

    /// Numbers the members 0, 1, … row by row. Members added later are not numbered.
    void number_members() {
        before_.resize(words_.size());
        uint32_t count = 0;
        for (size_t i = 0; i < words_.size(); ++i) {
            before_[i] = count;
            count += static_cast<uint32_t>(std::popcount(words_[i]));
        }
        count_ = count;
    }
    /// Members when they were numbered.
    size_t count() const { return count_; }

    /// A member's number.
    uint32_t number(GridPoint p) const {
        const uint64_t below = (uint64_t{1} << (index(p) % 64)) - 1;
        return before_[index(p) / 64] + static_cast<uint32_t>(std::popcount(words_[index(p) / 64] & below));
    }

  private:
    size_t index(GridPoint p) const { return static_cast<size_t>(p.y) * columns_ + static_cast<size_t>(p.x); }

    size_t columns_;
    std::vector<uint64_t> words_;
    std::vector<uint32_t> before_;  // [word]: members in the words before
    size_t count_ = 0;
};

}  // namespace terrain
