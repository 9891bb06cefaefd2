// PageDirectory: which pages of a layout a store holds, in the order of its file.
//
// Where the ground is level nothing needs to be stored: such pages say the same all over a group. A store that leaves
// some out begins with one *level page* a group (level_page.h), which stands for all that it lacks.
//
//     entry    0 .. level_count - 1      the level pages, coarsest group first; none in a store that lacks nothing
//              level_count .. count - 1  pages, by number; with each the one above it
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "terrain/page_layout.h"
#include "terrain/page_map.h"
#include "terrain/store/page_tree.h"

namespace terrain {

class PageDirectory {
  public:
    static constexpr uint32_t kNone = 0xffffffffu;  ///< entry of a page that the store lacks

    /// @param numbers  of the pages held, rising, below layout.page_count(); the root's page among them
    PageDirectory(const PageLayout& layout, std::vector<uint64_t> numbers)
        : layout_(layout),
          level_count_(numbers.size() == layout.page_count() ? 0 : static_cast<size_t>(layout.group_count())),
          numbers_(std::move(numbers)),
          entries_(layout.page_count(), kNone) {
        for (size_t i = 0; i < numbers_.size(); ++i)
            entries_.set(numbers_[i], static_cast<uint32_t>(level_count_ + i));
    }

    /// Whether the numbers rise, lie in the layout, and each page's parent is there.
    static bool is_sound(const PageLayout& layout, std::span<const uint64_t> numbers) {
        if (numbers.empty() || numbers[0] != 0) return false;
        for (size_t i = 1; i < numbers.size(); ++i) {
            if (numbers[i] <= numbers[i - 1] || numbers[i] >= layout.page_count()) return false;
            const uint64_t above = layout.number(parent_of(layout, layout.id(numbers[i])));
            if (!std::binary_search(numbers.begin(), numbers.begin() + static_cast<ptrdiff_t>(i), above))
                return false;
        }
        return true;
    }

    const PageLayout& layout() const { return layout_; }
    size_t count() const { return level_count_ + numbers_.size(); }
    size_t level_count() const { return level_count_; }
    bool is_level(size_t entry) const { return entry < level_count_; }
    const std::vector<uint64_t>& numbers() const { return numbers_; }

    /// Of an entry that is no level page.
    size_t number(size_t entry) const { return numbers_[entry - level_count_]; }
    PageId id(size_t entry) const { return layout_.id(number(entry)); }
    /// kNone: level ground.
    uint32_t entry_of(const PageId& id) const { return entries_[layout_.number(id)]; }
    /// The entry of the page above; the root's has none.
    size_t parent(size_t entry) const { return entry_of(parent_of(layout_, id(entry))); }
    /// The first entry of a page of this or a finer group; count() when there is none.
    size_t first_of_group(int group) const {
        const uint64_t first =
            group == layout_.group_count() ? layout_.page_count() : layout_.number({group, 0, 0});
        return level_count_ + static_cast<size_t>(std::lower_bound(numbers_.begin(), numbers_.end(), first) -
                                                  numbers_.begin());
    }
    /// Calls visit(entry) for the pages held right below an entry's.
    template <typename Visit>
    void for_each_child(size_t entry, const Visit& visit) const {
        terrain::for_each_child(layout_, id(entry), [&](const PageId& child) {
            if (const uint32_t below = entry_of(child); below != kNone) visit(size_t{below});
        });
    }

    /// A table's map: what the store holds is at `slot_of(entry)`, what it lacks at its group's level page, which lies in
    /// the slot of its entry.
    template <typename SlotOf>
    PageMap slots(const SlotOf& slot_of) const {
        PageMap map(layout_.page_count(), kNone);
        for (size_t group = 0; group < level_count_; ++group) {
            const size_t next = group + 1 == level_count_
                                    ? layout_.page_count()
                                    : layout_.number({static_cast<int>(group) + 1, 0, 0});
            map.fill(layout_.number({static_cast<int>(group), 0, 0}), next, static_cast<uint32_t>(group));
        }
        for (size_t entry = level_count_; entry < count(); ++entry)
            map.set(number(entry), slot_of(entry));
        return map;
    }

    uint64_t memory_bytes() const { return numbers_.size() * sizeof(uint64_t) + entries_.memory_bytes(); }

  private:
    PageLayout layout_;
    size_t level_count_;
    std::vector<uint64_t> numbers_;  ///< [entry - level_count_]
    PageMap entries_;                ///< [page]
};

}  // namespace terrain
