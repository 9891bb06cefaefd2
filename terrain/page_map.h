// PageMap: a number for every page of a layout, in little memory where neighbours have the same.
//
// Shelves of 1024 pages; whole shelves of one number are one shelf. The Earth at an arc second has 360 million pages:
// 1.4 MB, and 4 KB a shelf on which they differ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace terrain {

class PageMap {
  public:
    PageMap() = default;
    /// All have this number.
    PageMap(size_t page_count, uint32_t value) : page_count_(page_count) {
        shelf_of_.assign((page_count + kShelf - 1) / kShelf, add_shelf(value, true));
    }

    size_t size() const { return page_count_; }
    uint32_t operator[](size_t page) const {
        return values_[size_t(shelf_of_[page / kShelf]) * kShelf + page % kShelf];
    }

    /// Allocates when the page is the first of its shelf that differs.
    void set(size_t page, uint32_t value) { own_shelf(page / kShelf)[page % kShelf] = value; }

    /// Sets pages [begin, end). Cost: of shelves that are covered whole, one is written.
    void fill(size_t begin, size_t end, uint32_t value) {
        uint32_t whole = kNone;
        for (size_t page = begin; page < end;) {
            if (page % kShelf != 0 || page + kShelf > end) {
                set(page++, value);
                continue;
            }
            if (whole == kNone) whole = add_shelf(value, true);
            shelf_of_[page / kShelf] = whole;
            page += kShelf;
        }
    }

    uint64_t memory_bytes() const {
        return (shelf_of_.capacity() + values_.capacity()) * sizeof(uint32_t) + is_shared_.capacity();
    }

  private:
    static constexpr size_t kShelf = 1024;
    static constexpr uint32_t kNone = 0xffffffffu;

    uint32_t add_shelf(uint32_t value, bool is_shared) {
        values_.insert(values_.end(), kShelf, value);
        is_shared_.push_back(is_shared ? 1 : 0);
        return static_cast<uint32_t>(is_shared_.size() - 1);
    }
    uint32_t* own_shelf(size_t place) {
        const uint32_t shelf = shelf_of_[place];
        if (is_shared_[shelf] != 0) {
            shelf_of_[place] = add_shelf(values_[size_t(shelf) * kShelf], false);
        }
        return &values_[size_t(shelf_of_[place]) * kShelf];
    }

    size_t page_count_ = 0;
    std::vector<uint32_t> shelf_of_;  ///< [page / kShelf]
    std::vector<uint32_t> values_;    ///< [shelf][kShelf]
    std::vector<uint8_t> is_shared_;  ///< [shelf] holds one number and may stand in several places
};

}  // namespace terrain
