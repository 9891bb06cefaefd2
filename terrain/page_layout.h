// PageLayout: which page of a diamond table holds which diamond, and where in it.
//
// A page holds both levels of one group (the square level 2g and the turned level 2g + 1, which have the same
// reach) over a block of 64 x 64 square diamonds, about 100 KB of facts: the children of a diamond are nearly
// always in one page, and a page is what a store on disk loads and drops as a whole.
//
//     square level   i, j = x, y / (2 reach)               entry (j & 63) * 64 + (i & 63)
//     turned level   c = x / (2 reach), r = y / reach      entry 4096 + (r - 128 by) * 65 + (c - 64 bx)
//
// The turned level has one more column and row than fit into whole blocks; the last block of each takes them.
// Pages are numbered coarsest group first, rows of blocks within a group. Ids have 64 bits: a domain of 2^28
// blocks a side, the Earth at millimetres, would not exhaust them.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/diamond.h"

namespace terrain {

inline constexpr int kPageSideLog2 = 6;
inline constexpr int kPageSide = 1 << kPageSideLog2;
inline constexpr size_t kSquareEntries = size_t(kPageSide) * kPageSide;
inline constexpr int kTurnedColumns = kPageSide + 1, kTurnedRows = 2 * kPageSide + 1;
inline constexpr size_t kPageEntries = kSquareEntries + size_t(kTurnedColumns) * kTurnedRows;

/// Name of a page, independent of how many there are.
struct PageId {
    int group = 0;  ///< levels 2 group and 2 group + 1
    int block_x = 0, block_y = 0;
    bool operator==(const PageId&) const = default;

    uint64_t key() const {
        return uint64_t(group) << 56 | uint64_t(uint32_t(block_y)) << 28 | uint64_t(uint32_t(block_x));
    }
};

/// A diamond's place.
struct PagePlace {
    size_t page = 0;   ///< number, below page_count()
    size_t entry = 0;  ///< below kPageEntries
};

class PageLayout {
  public:
    explicit PageLayout(const Domain& domain) {
        for (int group = 0; 2 * group <= domain.finest_level(); ++group) {
            const int reach = domain.reach(2 * group);
            Group g;
            g.first_page = page_count_;
            g.reach_log2 = std::countr_zero(static_cast<unsigned>(reach));
            g.blocks = std::max(1, (domain.side() / (2 * reach)) >> kPageSideLog2);
            page_count_ += static_cast<size_t>(g.blocks) * static_cast<size_t>(g.blocks);
            groups_.push_back(g);
        }
    }

    size_t page_count() const { return page_count_; }
    int group_count() const { return static_cast<int>(groups_.size()); }
    /// Blocks a side of a group.
    int blocks(int group) const { return groups_[static_cast<size_t>(group)].blocks; }

    /// Place of a diamond; its centre must be one of this level's.
    PagePlace place(GridPoint centre, int level) const {
        const Group& g = groups_[static_cast<size_t>(level) >> 1];
        const int column = centre.x >> (g.reach_log2 + 1), row = centre.y >> (g.reach_log2 + 1);
        if ((level & 1) == 0) {
            const int bx = column >> kPageSideLog2, by = row >> kPageSideLog2;
            return {number(g, bx, by), static_cast<size_t>((row - (by << kPageSideLog2)) * kPageSide +
                                                           column - (bx << kPageSideLog2))};
        }
        const int turned_row = centre.y >> g.reach_log2;
        const int bx = std::min(column >> kPageSideLog2, g.blocks - 1);
        const int by = std::min(turned_row >> (kPageSideLog2 + 1), g.blocks - 1);
        return {
            number(g, bx, by),
            kSquareEntries + static_cast<size_t>((turned_row - (by << (kPageSideLog2 + 1))) * kTurnedColumns +
                                                 column - (bx << kPageSideLog2))};
    }

    size_t number(const PageId& id) const {
        return number(groups_[static_cast<size_t>(id.group)], id.block_x, id.block_y);
    }
    PageId id(size_t page) const {
        size_t group = groups_.size() - 1;
        while (groups_[group].first_page > page)
            --group;
        const Group& g = groups_[group];
        const size_t rest = page - g.first_page, blocks = static_cast<size_t>(g.blocks);
        return {static_cast<int>(group), static_cast<int>(rest % blocks), static_cast<int>(rest / blocks)};
    }

  private:
    struct Group {
        size_t first_page = 0;
        int reach_log2 = 0;
        int blocks = 1;
    };
    static size_t number(const Group& g, int bx, int by) {
        return g.first_page + static_cast<size_t>(by) * static_cast<size_t>(g.blocks) +
               static_cast<size_t>(bx);
    }

    std::vector<Group> groups_;
    size_t page_count_ = 0;
};

}  // namespace terrain
