// UnaskedDiamonds: new candidates in the order they came, whose facts are on their way from memory.
#pragma once

#include <array>
#include <cstdint>

#include "lod/base/check.h"
#include "terrain/diamond_mesh.h"
#include "terrain/diamond_source.h"

namespace terrain {

struct Unasked {
    DiamondIndex index = kOutside;
    const DiamondSource* facts = nullptr;  ///< in the table; the page stays until the next frame
};

/// First in, first out. Room for what the longest chain of forced splits makes: two levels an octave, four each.
class UnaskedDiamonds {
  public:
    bool is_empty() const { return begin_ == end_; }
    uint32_t size() const { return end_ - begin_; }
    void clear() { begin_ = end_ = 0; }
    void push(const Unasked& candidate) {
        DCHECK(size() < kRoom);
        ring_[end_++ % kRoom] = candidate;
    }
    Unasked pop() {
        DCHECK(!is_empty());
        return ring_[begin_++ % kRoom];
    }

  private:
    static constexpr uint32_t kRoom = 256;
    std::array<Unasked, kRoom> ring_;
    uint32_t begin_ = 0, end_ = 0;  ///< count up for ever
};

}  // namespace terrain
