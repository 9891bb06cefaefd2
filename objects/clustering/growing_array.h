// GrowingArray: an array that is never moved while it grows, so that no moment needs room for two of it.
//
//     blocks   [ 4096 ][ 4096 ][ 8192 ][ 16384 ] …    each as large as all before it, up to 64 MB
//
// What is appended at once lies together; only the end of a block may stay empty.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace objects {

template <typename T>
class GrowingArray {
  public:
    size_t size() const { return size_; }

    /// @returns where the items begin
    size_t append(std::span<const T> items) {
        const size_t begin = size_;
        if (blocks_.empty() || blocks_.back().items.size() + items.size() > blocks_.back().items.capacity()) {
            blocks_.push_back({begin, {}});
            blocks_.back().items.reserve(std::max(std::clamp(begin, kFewest, kMost), items.size()));
        }
        std::vector<T>& last = blocks_.back().items;
        last.insert(last.end(), items.begin(), items.end());
        size_ += items.size();
        return begin;
    }

    /// What was appended at `begin`.
    std::span<const T> at(size_t begin, size_t count) const {
        const auto after =
            std::upper_bound(blocks_.begin(), blocks_.end(), begin,
                             [](size_t index, const Block& block) { return index < block.begin; });
        if (after == blocks_.begin()) return {};
        const Block& block = *std::prev(after);
        return std::span<const T>(block.items).subspan(begin - block.begin, count);
    }

    /// Everything in one piece; the blocks are freed one by one meanwhile, and nothing is left.
    std::vector<T> release() {
        std::vector<T> all;
        all.reserve(size_);
        for (Block& block : blocks_) {
            all.insert(all.end(), block.items.begin(), block.items.end());
            block.items = {};
        }
        *this = GrowingArray();
        return all;
    }

  private:
    static constexpr size_t kFewest = 4096, kMost = (size_t{64} << 20) / sizeof(T);
    struct Block {
        size_t begin = 0;
        std::vector<T> items;
    };
    std::vector<Block> blocks_;
    size_t size_ = 0;
};

}  // namespace objects
