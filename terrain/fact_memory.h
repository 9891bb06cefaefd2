// FactMemory: the array a diamond table's facts lie in: memory of its own, or a file that the system pages.
//
// Both are mappings: memory begins as zeros without being touched, a table larger than memory can be filled in
// place, and what a table is made of does not show to those who read it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "terrain/diamond_source.h"

namespace terrain {

/// A copy is memory of its own, whatever it was copied from.
class FactMemory {
  public:
    FactMemory() = default;
    /// Zeros. CHECKs that there is address space.
    explicit FactMemory(size_t count);
    FactMemory(const FactMemory& other);
    FactMemory(FactMemory&& other) noexcept { swap(other); }
    FactMemory& operator=(FactMemory other) noexcept {
        swap(other);
        return *this;
    }
    ~FactMemory();

    /// Part of an open file; the file may be closed afterwards. Empty when the system refuses.
    /// @param offset_bytes  where in the file, a multiple of the system's page size
    /// @param is_writable   writing changes the file; otherwise writing is a mistake
    static FactMemory of_file(int file, uint64_t offset_bytes, size_t count, bool is_writable);

    size_t size() const { return count_; }
    const DiamondSource* data() const { return facts_; }
    DiamondSource* data() { return facts_; }
    const DiamondSource& operator[](size_t index) const { return facts_[index]; }
    DiamondSource& operator[](size_t index) { return facts_[index]; }
    const DiamondSource* begin() const { return facts_; }
    const DiamondSource* end() const { return facts_ + count_; }

  private:
    void swap(FactMemory& other) noexcept {
        std::swap(facts_, other.facts_);
        std::swap(count_, other.count_);
    }

    DiamondSource* facts_ = nullptr;
    size_t count_ = 0;
};

}  // namespace terrain
